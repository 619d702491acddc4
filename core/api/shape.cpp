#include "candela/shape.h"

#include <string_view>

namespace candela {

MeshSink::~MeshSink() = default;
void MeshSink::warn(std::string_view) {}
void MeshSink::progress(double) {}
Shape::~Shape() = default;

}  // namespace candela
