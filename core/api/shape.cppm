module;

#include "candela/shape.h"

export module candela.shape;

export import candela.descriptor;
export import candela.math;

export namespace candela {
using candela::Closedness;
using candela::MeshLayout;
using candela::MeshRequest;
using candela::MeshSink;
using candela::MeshSpans;
using candela::Shape;
using candela::welded;
}  // namespace candela
