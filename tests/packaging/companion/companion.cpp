// A model that takes its reflectance from its own data file and library: a quarter, whatever the directions.
#include <cstddef>
#include <fstream>
#include <stdexcept>

#include "candela/plugin_files.h"
#include "candela/reflection_plugin.h"

float share_of_private_library();

using namespace candela;

class Companion final : public ReflectionModel {
  public:
    explicit Companion(const sdk::NoParams&) {
        const auto path = sdk::data_folder() / "share.txt";
        float share = 0;
        if (!(std::ifstream(path) >> share)) throw std::runtime_error("cannot read " + path.string());
        share_ = share * share_of_private_library();
    }
    void reflect(const SurfaceBatch& surface, const LightingBatch& light,
                 const ReflectedBatch& reflected) const override {
        for (std::size_t i = 0; i < surface.count; ++i) {
            const bool above = dot(surface.normal[i], light.to_light[i]) > 0;
            reflected.diffuse.set(i, reflected.diffuse[i] + (above ? share_ : 0) * light.diffuse[i]);
        }
    }
    void reflect_ambient(const SurfaceBatch&, const ConstVec3Span&, const ReflectedBatch&) const override {}

  private:
    float share_ = 0;
};

CANDELA_PLUGIN(reflection, Companion, sdk::k_no_fields,
               {.title = "Companion", .summary = "Reflects as its data file says."})
