// A reflection model that throws: on creation with a kd of zero, otherwise when it reflects.
#include <stdexcept>

#include "candela/reflection_plugin.h"

using namespace candela::sdk;

namespace {

struct Params {
    vec3 kd;
};

class Throwing final : public candela::ReflectionModel {
  public:
    explicit Throwing(const Params& params) {
        if (params.kd.x == 0) throw std::runtime_error("no model without light");
    }
    void reflect(const candela::SurfaceBatch&, const candela::LightingBatch&,
                 const candela::ReflectedBatch&) const override {
        throw std::runtime_error("out of photons");
    }
    void reflect_ambient(const candela::SurfaceBatch&, const candela::ConstVec3Span&,
                         const candela::ReflectedBatch&) const override {
        throw 42;
    }
};

constexpr auto k_fields = fields(coefficient(&Params::kd, "kd", 0.5f, "zero throws"));

}  // namespace

CANDELA_PLUGIN(reflection, Throwing, k_fields, {.title = "Throwing"})
