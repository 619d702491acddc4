module;

#include "candela/punctual.h"

export module candela.punctual;

export import candela.color;
export import candela.math;

export namespace candela {
using candela::PunctualLight;
using candela::PunctualLighting;
}  // namespace candela
