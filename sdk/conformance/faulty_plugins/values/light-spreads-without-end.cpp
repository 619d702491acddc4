// As data, it extends infinitely.
#include <limits>

#include "faulty_light.h"

namespace {
class SpreadsWithoutEnd final : public faulty::Lamp, public candela::PunctualSource {
  public:
    explicit SpreadsWithoutEnd(const faulty::LampParams& params) : Lamp(params), lamp_(params) {}
    candela::PunctualLight as_punctual(int) const override {
        candela::PunctualLight light = candela::sdk::punctual_light(
            candela::kernel::punctual_source(lamp_.position, candela::sdk::vec3(1.0f), 1, 0, 0));
        light.extent_u.x = std::numeric_limits<float>::infinity();
        return light;
    }

  private:
    faulty::LampParams lamp_;
};
}  // namespace

FAULTY_LIGHT(SpreadsWithoutEnd)
