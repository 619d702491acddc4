// Never writes its light for highlights.
#include "faulty_light.h"

namespace {
class ForgetsHighlights final : public faulty::Lamp {
    using Lamp::Lamp;
    bool has_highlights() const override { return false; }
};
}  // namespace

FAULTY_LIGHT(ForgetsHighlights)
