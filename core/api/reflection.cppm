module;

#include "candela/reflection_model.h"

export module candela.reflection;

export import candela.descriptor;
export import candela.math;
export import candela.punctual;

export namespace candela {
using candela::ExitBatch;
using candela::LightingBatch;
using candela::ReflectedBatch;
using candela::ReflectionModel;
using candela::SurfaceBatch;
using candela::Surroundings;
}  // namespace candela
