// Its description as data omits the attenuation.
#include "faulty_light.h"

namespace {
class DescribesAnother final : public faulty::Lamp, public candela::PunctualSource {
  public:
    explicit DescribesAnother(const faulty::LampParams& params) : Lamp(params), lamp_(params) {}
    candela::PunctualLight as_punctual(int) const override {
        return candela::sdk::punctual_light(
            candela::kernel::punctual_source(lamp_.position, candela::sdk::vec3(1.0f), 1, 2, 0));
    }

  private:
    faulty::LampParams lamp_;
};
}  // namespace

FAULTY_LIGHT(DescribesAnother)
