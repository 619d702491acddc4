module;

#include "candela/shading_model.h"

export module candela.shading;

export import candela.descriptor;
export import candela.math;

export namespace candela {
using candela::MeshView;
using candela::ShadingModel;
using candela::ShadingNeeds;
using candela::ShadingPointBatch;
using candela::ShadingRate;
using candela::TriangleBatch;
}  // namespace candela
