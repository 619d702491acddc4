module;

#include <string_view>

module candela.shape;

namespace candela {

MeshSink::~MeshSink() = default;
void MeshSink::warn(std::string_view) {}
Shape::~Shape() = default;

}  // namespace candela
