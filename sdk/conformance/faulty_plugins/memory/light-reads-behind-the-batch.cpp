// Reads one past the last receiver without using the value.
#include "faulty_light.h"

namespace {
class ReadsBehindTheBatch final : public faulty::Lamp {
    using Lamp::Lamp;
    void illuminate(int sample, const candela::ReceiverBatch& receivers,
                    const candela::IncidentBatch& incident) const override {
        Lamp::illuminate(sample, receivers, incident);
        [[maybe_unused]] const volatile float next = receivers.position.y[receivers.count];
    }
};
}  // namespace

FAULTY_LIGHT(ReadsBehindTheBatch)
