// Never writes its light for highlights.
#include "museum_light.h"

namespace {
class ForgetsHighlights final : public museum::Lamp {
    using Lamp::Lamp;
    bool has_highlights() const override { return false; }
};
}  // namespace

MUSEUM_LAMP(ForgetsHighlights)
