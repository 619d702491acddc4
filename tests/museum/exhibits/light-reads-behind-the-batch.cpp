// Reads one past the last receiver without using the value.
#include "museum_light.h"

namespace {
class ReadsBehindTheBatch final : public museum::Lamp {
    using Lamp::Lamp;
    void illuminate(int sample, const candela::ReceiverBatch& receivers,
                    const candela::IncidentBatch& incident) const override {
        Lamp::illuminate(sample, receivers, incident);
        [[maybe_unused]] const volatile float next = receivers.position.y[receivers.count];
    }
};
}  // namespace

MUSEUM_LAMP(ReadsBehindTheBatch)
