#include <unistd.h>

#include "museum_light.h"

namespace {
class NeverReturns final : public museum::Lamp {
    using Lamp::Lamp;
    void illuminate(int, const candela::ReceiverBatch&, const candela::IncidentBatch&) const override {
        for (;;) ::pause();
    }
};
}  // namespace

MUSEUM_LAMP(NeverReturns)
