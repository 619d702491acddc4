// A PPM writer that writes blue where red belongs.
#include "faulty_reflection.h"

namespace {
class SwapsChannels final : public faulty::Ppm {
    using Ppm::Ppm;
    std::size_t channel(std::size_t c) const override { return 2 - c; }
};
}  // namespace

FAULTY_FORMAT(SwapsChannels)
