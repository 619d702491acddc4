// A tetrahedron that declares itself closed, but faces inwards.
#include "faulty_shape.h"

namespace {
class InsideOut final : public faulty::Tetrahedron {
    using Tetrahedron::Tetrahedron;
    std::vector<std::uint32_t> corners() const override { return {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2}; }
};
}  // namespace

FAULTY_SHAPE(InsideOut)
