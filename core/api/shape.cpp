#include "candela/shape.h"

namespace candela {

MeshSink::~MeshSink() = default;
Shape::~Shape() = default;

}  // namespace candela
