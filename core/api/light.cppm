module;

#include "candela/light.h"

export module candela.light;

export import candela.descriptor;
export import candela.math;
export import candela.punctual;

export namespace candela {
using candela::IncidentBatch;
using candela::Light;
using candela::ReceiverBatch;
}  // namespace candela
