// A reflection model that takes a value of every type, for the JSON Schema: one of them required, and a `kd`
// unlike that of the shipped models.
#include "candela/reflection_plugin.h"

using namespace candela::sdk;

namespace {

struct Params {
    float gloss, kd;
    std::int32_t layers, metallic, finish;
    const char* label;
    vec3 tint, grain, anchor, axis, weights;
    mat3 turn;
    Table ramp;
};

class EveryType : public candela::ReflectionModel {
  public:
    explicit EveryType(const Params&) {}
    void reflect(const candela::SurfaceBatch&, const candela::LightingBatch&,
                 const candela::ReflectedBatch&) const override {}
    void reflect_ambient(const candela::SurfaceBatch&, const candela::ConstVec3Span&,
                         const candela::ReflectedBatch&) const override {}
};

constexpr const char* k_finishes[] = {"matt", "satin"};
constexpr float k_ramp[] = {0, 1};

constexpr auto k_fields = fields(
    real(&Params::gloss, "gloss", 0, "required").above(0).maximum(1).required(),
    real(&Params::kd, "kd", 1, "a number, and up to 2").range(0, 2),
    integer(&Params::layers, "layers", 2, "coats").range(1, 8),
    boolean(&Params::metallic, "metallic", false, "whether it is a metal"),
    choice(&Params::finish, "finish", k_finishes, "how it was polished"),
    Field<Params>{.spec = {.name = "label", .type = candela::ParamType::text, .meaning = "for the shop"},
                  .text = &Params::label},
    color(&Params::tint, "tint", vec3(255), "of the highlight"),
    three(&Params::grain, candela::ParamType::vector, "grain", vec3(0), "how it runs").range(-2, 2),
    three(&Params::anchor, candela::ParamType::point, "anchor", vec3(0), "where it begins"),
    three(&Params::axis, candela::ParamType::direction, "axis", vec3(0, 1, 0), "which way it goes"),
    three(&Params::weights, candela::ParamType::rgb, "weights", vec3(0.5f), "of the channels").below(1),
    matrix(&Params::turn, "turn", "of the grain").range(-1, 1),
    numbers(&Params::ramp, "ramp", k_ramp, "of the gloss").minimum(0));

}  // namespace

CANDELA_PLUGIN(reflection, EveryType, k_fields,
               {.title = "Every type", .summary = "It reflects nothing.", .reference = "none"})
