// Shared by the faulty lights: a handwritten point light without fault, to be spoiled.
#pragma once

#include <cmath>
#include <cstddef>

#include "candela/light_plugin.h"

namespace faulty {

struct LampParams {
    candela::sdk::vec3 position;
};

constexpr auto k_lamp_fields =
    candela::sdk::fields(candela::sdk::point(&LampParams::position, "position", "where it is"));
constexpr candela::Property k_lamp_properties[] = {{"attenuation", "by distance"}};

class Lamp : public candela::Light {
  public:
    explicit Lamp(const LampParams& params)
        : position_{params.position.x, params.position.y, params.position.z} {}
    int sample_count() const noexcept override { return 1; }
    void illuminate(int, const candela::ReceiverBatch& receivers,
                    const candela::IncidentBatch& incident) const override {
        for (std::size_t i = 0; i < receivers.count; ++i) {
            const candela::Vec3 offset = position_ - receivers.position[i];
            const float distance = std::sqrt(dot(offset, offset));
            const candela::Vec3 towards = distance > 0 ? (1 / distance) * offset : candela::Vec3{0, 1, 0};
            const float light = intensity(distance);
            incident.to_light.set(i, direction(towards));
            incident.diffuse.set(i, {light, light, light});
            if (has_highlights()) incident.specular.set(i, {light, light, light});
        }
    }

  protected:
    virtual float intensity(float distance) const { return 1 / (0.01f + distance * distance); }
    virtual candela::Vec3 direction(candela::Vec3 towards) const { return towards; }
    virtual bool has_highlights() const { return true; }

  private:
    candela::Vec3 position_;
};

}  // namespace faulty

#define FAULTY_LIGHT(Model)                             \
    CANDELA_PLUGIN(light, Model, faulty::k_lamp_fields, \
                   {.title = #Model, .summary = "Bad on purpose.", .properties = faulty::k_lamp_properties})
