module;

#include "candela/math.h"

export module candela.math;

export namespace candela {
using candela::Vec3;
using candela::operator+;
using candela::operator-;
using candela::operator*;
using candela::ConstVec2Span;
using candela::ConstVec3Span;
using candela::cross;
using candela::dot;
using candela::length;
using candela::Matrix;
using candela::normalized;
using candela::Vec2Span;
using candela::Vec3Span;
}  // namespace candela
