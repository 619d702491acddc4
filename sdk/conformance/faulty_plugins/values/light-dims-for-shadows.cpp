// Sends half its light if it is asked for its distance.
#include <cstddef>

#include "faulty_light.h"

namespace {
class DimsForShadows final : public faulty::Lamp {
    using Lamp::Lamp;
    void illuminate(int sample, const candela::ReceiverBatch& receivers,
                    const candela::IncidentBatch& incident) const override {
        Lamp::illuminate(sample, receivers, incident);
        for (std::size_t i = 0; incident.distance != nullptr && i < receivers.count; ++i)
            incident.diffuse.set(i, 0.5f * candela::ConstVec3Span(incident.diffuse)[i]);
    }
};
}  // namespace

FAULTY_LIGHT(DimsForShadows)
