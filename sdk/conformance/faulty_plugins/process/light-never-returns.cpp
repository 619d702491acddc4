#include <unistd.h>

#include "faulty_light.h"

namespace {
class NeverReturns final : public faulty::Lamp {
    using Lamp::Lamp;
    void illuminate(int, const candela::ReceiverBatch&, const candela::IncidentBatch&) const override {
        for (;;) ::pause();
    }
};
}  // namespace

FAULTY_LIGHT(NeverReturns)
