// Its description as data omits the attenuation.
#include "museum_light.h"

namespace {
class DescribesAnother final : public museum::Lamp {
  public:
    explicit DescribesAnother(const museum::LampParams& params) : Lamp(params), lamp_(params) {}
    bool as_punctual(int, candela::PunctualLight& light) const override {
        light = candela::sdk::punctual_source(lamp_.position, candela::sdk::vec3(1.0f), 1, 2, 0);
        return true;
    }

  private:
    museum::LampParams lamp_;
};
}  // namespace

MUSEUM_LAMP(DescribesAnother)
