// Says that it is a negative distance away.
#include <cstddef>

#include "faulty_light.h"

namespace {
class IsBehindItself final : public faulty::Lamp {
    using Lamp::Lamp;
    void illuminate(int sample, const candela::ReceiverBatch& receivers,
                    const candela::IncidentBatch& incident) const override {
        Lamp::illuminate(sample, receivers, incident);
        for (std::size_t i = 0; incident.distance != nullptr && i < receivers.count; ++i)
            incident.distance[i] = -1;
    }
};
}  // namespace

FAULTY_LIGHT(IsBehindItself)
