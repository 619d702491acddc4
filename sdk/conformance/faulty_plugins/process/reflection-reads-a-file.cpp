// Without fault: it needs a file, reads a point's position, and is energy-bounded in only one of its forms.
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "faulty_reflection.h"

namespace {
struct FileParams {
    const char* file;
    std::int32_t form;
};
constexpr const char* k_forms[] = {"true", "exaggerated"};
constexpr auto k_fields = candela::sdk::fields(
    candela::sdk::file(&FileParams::file, "file", "how much light is reflected"),
    candela::sdk::choice(&FileParams::form, "form", k_forms, "as it is, or four times as bright"));

class ReadsAFile final : public faulty::Matt {
  public:
    explicit ReadsAFile(const FileParams& params)
        : Matt(faulty::Params{candela::sdk::vec3(read(params.file))}) {
        if (params.form == 1) kd_ *= 4;
    }

  private:
    static float read(const char* path) {
        float value = 0;
        if (!(std::ifstream(path) >> value))
            throw std::runtime_error("cannot read '" + std::string(path) + "'");
        return value;
    }
    float factor(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 std::size_t i) const override {
        return std::isfinite(s.position.x[i]) ? Matt::factor(s, light, i) : 0;
    }
};
constexpr candela::Property k_properties[] = {
    {"reciprocal"}, {"energy-bounded", "where form is true"}, {"isotropic"}};
}  // namespace

CANDELA_PLUGIN(
    reflection, ReadsAFile, k_fields,
    {.title = "Reads a file", .summary = "Sound.", .reference = "none", .properties = k_properties})
