// A PPM writer that writes blue where red belongs.
#include "museum.h"

namespace {
class SwapsChannels final : public museum::Ppm {
    using Ppm::Ppm;
    std::size_t channel(std::size_t c) const override { return 2 - c; }
};
}  // namespace

MUSEUM_FORMAT(SwapsChannels)
