#include "candela/shape.h"

#include <string_view>

namespace candela {

MeshSink::~MeshSink() = default;
void MeshSink::warn(std::string_view) {}
Shape::~Shape() = default;

}  // namespace candela
