module;

#include "candela/transform.h"

export module candela.transform;

export import candela.math;

export namespace candela {
using candela::Projection;
using candela::Transform;
}  // namespace candela
