module;

#include "candela/target.h"

export module candela.target;

export import candela.descriptor;
export import candela.math;
export import candela.punctual;
export import candela.shading;
export import candela.transform;

export namespace candela {
using candela::ExportedGeometry;
using candela::ExportedImage;
using candela::ExportedLight;
using candela::ExportedMesh;
using candela::ExportedModel;
using candela::ExportedObject;
using candela::ExportedObserver;
using candela::ExportedReflection;
using candela::ExportedSample;
using candela::ExportedScene;
using candela::ExportedShading;
using candela::ExportedTexture;
using candela::ExportedTextureLevel;
using candela::ExportedValues;
using candela::FileSink;
using candela::ProgramResult;
using candela::ProgramRunner;
using candela::Target;
using candela::TargetAbilities;
}  // namespace candela
