// A scene as a generated program has it: checked, with the kernels of all its models.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "kernel_source.h"

import candela.core;

namespace generate {

/// A plugin whose kernel goes into the program.
struct ExportedModel {
    const candela::Manifest* manifest = nullptr;  // the registry's
    KernelSource kernel;

    const std::string& name() const { return manifest->name; }
};

struct ExportedShading : ExportedModel {
    candela::ShadingRate rate = candela::ShadingRate::fragment;
    candela::ShadingNeeds needs;
};

struct ExportedReflection : ExportedModel {
    bool needs_tangent = false;
};

struct ExportedLight {
    std::string label;
    std::size_t model = 0;  // of ExportedScene::light_models
    candela::ParamSet values;
};

struct ExportedObject {
    std::string label;
    candela::Vec3 color;                       // 0-255
    std::size_t shading = 0, reflection = 0;   // its own models
    std::vector<candela::ParamSet> shadings;   // values for each shading model of the scene
    std::vector<candela::ParamSet> materials;  // values for each reflection model
    std::string shape;                         // the plugin
    candela::ParamSet shape_values;
    std::optional<ExportedModel> shape_model;  // where the shape has a kernel
    std::unique_ptr<candela::Shape> tessellator;
    candela::Transform transform;
    bool closed = false;
};

struct ExportedScene {
    std::string title;
    candela::Observer observer;
    candela::ImageSettings image;
    std::vector<ExportedModel> light_models;
    std::vector<ExportedLight> lights;
    std::vector<ExportedShading> shadings;        // those of the objects, then those to switch to
    std::vector<ExportedReflection> reflections;  // likewise
    std::vector<ExportedObject> objects;

    /// Whether a model reads partial derivatives of positions.
    bool needs_derivatives() const;
    bool needs_uv() const;
    /// The kernels of the lights, reflection models and shading models.
    std::vector<const ExportedModel*> models() const;
};

/// Models to switch to beside those of the scene: names of reflection or shading models ("phong" is both),
/// ids such as "shading/flat", or "all", those that can be exported.
using ExtraModels = std::vector<std::string>;

/// The scene as it would be if all its objects had that shading or reflection model, or nothing where it
/// would not be valid.
using WithModel =
    std::function<std::optional<candela::Scene>(candela::PluginKind kind, const std::string& name)>;

/// Throws candela::Error where a model has no kernel, shows its surroundings, or clashes with another, and
/// where a name of `extra` is not known. `scene` has been compiled with `registry`.
ExportedScene exported(const candela::Scene& scene, const std::string& title, const ExtraModels& extra,
                       const WithModel& with_model, candela::Registry& registry);

/// Triangles in the world, and the unit normals of their vertices for each shading model of the scene.
struct WorldMesh {
    candela::Mesh mesh;
    std::vector<candela::Vec3Arrays> normals;  // the different ones
    std::vector<std::size_t> normals_of;       // a shading model each: which of them
};
WorldMesh world_mesh(const ExportedScene& scene, const ExportedObject& object, candela::Registry& registry);

}  // namespace generate
