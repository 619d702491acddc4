// Reads one past its last index without using the value.
#include "faulty_shape.h"

namespace {
class ReadsBehindItsMesh final : public faulty::Tetrahedron {
    using Tetrahedron::Tetrahedron;
    void look_at(const candela::MeshSpans& mesh) const override {
        [[maybe_unused]] const volatile std::uint32_t next = *(mesh.indices.data() + mesh.indices.size());
    }
};
}  // namespace

FAULTY_SHAPE(ReadsBehindItsMesh)
