// The interfaces of plugins and the data that crosses the boundary, as the headers of include/candela declare
// them.
module;

#include "candela/color.h"
#include "candela/extensions.h"
#include "candela/image_format.h"
#include "candela/light.h"
#include "candela/math.h"
#include "candela/parallel.h"
#include "candela/picture.h"
#include "candela/plugin/descriptor.h"
#include "candela/plugin/needs.h"
#include "candela/plugin/params.h"
#include "candela/pool.h"
#include "candela/punctual.h"
#include "candela/reflection_model.h"
#include "candela/scanline_image.h"
#include "candela/shading_model.h"
#include "candela/shape.h"
#include "candela/target.h"
#include "candela/transform.h"

export module candela.api;

export namespace candela {
// candela/color.h
using candela::Rgb;
using candela::operator+;
using candela::operator*;
using candela::ColorEncoding;
using candela::decoded;
using candela::linear_to_srgb;
using candela::PixelType;
using candela::srgb_to_linear;
using candela::ToneCurve;

// candela/plugin/descriptor.h
using candela::FileFormat;
using candela::Instance;
using candela::k_plugin_kinds;
using candela::KernelFunction;
using candela::KernelText;
using candela::name_of;
using candela::plugin_kind_named;
using candela::PluginDescriptor;
using candela::PluginKind;
using candela::Property;

// candela/extensions.h
using candela::AllLightsReflection;
using candela::Environment;
using candela::EnvironmentReflection;
using candela::ExitBatch;
using candela::extension_of;
using candela::GlossyReflection;
using candela::PunctualSource;
using candela::SkySource;
using candela::UniformAmbientSource;

// candela/image_format.h
using candela::ByteSink;
using candela::ImageChannel;
using candela::ImageFormat;
using candela::ImageSink;
using candela::ImageView;

// candela/light.h
using candela::IncidentBatch;
using candela::Light;
using candela::ReceiverBatch;

// candela/math.h
using candela::Vec3;
using candela::operator-;
using candela::ConstVec2Span;
using candela::ConstVec3Span;
using candela::cross;
using candela::dot;
using candela::length;
using candela::Matrix;
using candela::normalized;
using candela::Vec2Span;
using candela::Vec3Span;

// candela/parallel.h
using candela::available_threads;
using candela::current_threads;
using candela::FunctionRef;
using candela::parallel_for;
using candela::with_threads;

// candela/picture.h
using candela::Picture;
using candela::read_picture;

// candela/plugin/needs.h
using candela::ShadingNeeds;
using candela::SurfaceNeeds;

// candela/plugin/params.h
using candela::k_no_maximum;
using candela::k_no_minimum;
using candela::NumberList;
using candela::ParamSpec;
using candela::ParamType;
using candela::ParamValue;
using candela::PresetSpec;
using candela::PresetValue;
using candela::RelationSpec;
using candela::RelationType;

// candela/scanline_image.h
using candela::ImageRows;
using candela::RandomAccessSink;
using candela::ScanlineImageFormat;
using candela::ViewedRows;

// candela/pool.h
using candela::Pool;

// candela/punctual.h
using candela::PunctualLight;
using candela::PunctualLighting;

// candela/reflection_model.h
using candela::LightingBatch;
using candela::ReflectedBatch;
using candela::ReflectionModel;
using candela::SurfaceBatch;
using candela::VaryingParameter;

// candela/shading_model.h
using candela::MeshView;
using candela::ShadingModel;
using candela::ShadingPointBatch;
using candela::ShadingRate;
using candela::TriangleBatch;

// candela/shape.h
using candela::Closedness;
using candela::MeshLayout;
using candela::MeshRequest;
using candela::MeshSink;
using candela::MeshSpans;
using candela::Shape;
using candela::VertexChannel;
using candela::welded;

// candela/target.h
using candela::ExportedGeometry;
using candela::ExportedImage;
using candela::ExportedLight;
using candela::ExportedMesh;
using candela::ExportedModel;
using candela::ExportedNormalMap;
using candela::ExportedObject;
using candela::ExportedObserver;
using candela::ExportedRadianceMap;
using candela::ExportedReflection;
using candela::ExportedSample;
using candela::ExportedScene;
using candela::ExportedShading;
using candela::ExportedTexture;
using candela::ExportedTexturedNumber;
using candela::ExportedTextureLevel;
using candela::ExportedValues;
using candela::ExportedWrap;
using candela::FileSink;
using candela::ProgramResult;
using candela::ProgramRunner;
using candela::Target;
using candela::TargetAbilities;

// candela/transform.h
using candela::Projection;
using candela::Transform;
}  // namespace candela
