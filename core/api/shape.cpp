module candela.shape;

namespace candela {

MeshSink::~MeshSink() = default;
Shape::~Shape() = default;

}  // namespace candela
