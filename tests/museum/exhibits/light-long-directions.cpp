// The direction to the light is not a unit vector, and its light grows with distance although it declares
// otherwise.
#include "candela/light_plugin.h"

namespace {
struct Params {
    candela::sdk::vec3 position;
};
class LongDirections final : public candela::Light {
  public:
    explicit LongDirections(const Params& params)
        : position_{params.position.x, params.position.y, params.position.z} {}
    int sample_count() const noexcept override { return 1; }
    bool has_ambient() const noexcept override { return false; }
    void illuminate(int, const candela::ReceiverBatch& receivers,
                    const candela::IncidentBatch& incident) const override {
        for (std::size_t i = 0; i < receivers.count; ++i) {
            const candela::Vec3 offset = position_ - receivers.position[i];
            const float light = candela::length(offset);
            incident.to_light.set(i, offset);
            incident.diffuse.set(i, {light, light, light});
            incident.specular.set(i, {light, light, light});
        }
    }

  private:
    candela::Vec3 position_;
};
constexpr auto k_fields =
    candela::sdk::fields(candela::sdk::point(&Params::position, "position", "where it is"));
constexpr candela::Property k_properties[] = {{"attenuation", "by distance"}};
}  // namespace

CANDELA_PLUGIN(light, LongDirections, k_fields,
               {.title = "Long directions", .summary = "Bad on purpose.", .properties = k_properties})
