// A tetrahedron that declares itself closed, but lacks a face.
#include "faulty_shape.h"

namespace {
class HoleInIt final : public faulty::Tetrahedron {
    using Tetrahedron::Tetrahedron;
    std::vector<std::uint32_t> corners() const override { return {0, 1, 2, 0, 3, 1, 0, 2, 3}; }
};
}  // namespace

FAULTY_SHAPE(HoleInIt)
