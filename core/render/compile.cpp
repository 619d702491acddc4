// From a scene to meshes, lights and models.
module;

#include <fmt/format.h>

#include <exception>
#include <memory>
#include <string>
#include <utility>

module candela.render;

import candela.diagnostics;
import candela.light;
import candela.params;
import candela.plugins;
import candela.reflection;
import candela.scene;
import candela.shading;
import candela.shape;

namespace candela {

namespace {

/// A plugin's failure, with the object or light that wanted it.
template <class Interface>
std::unique_ptr<Interface> made(Registry& registry, const Model& model, ColorEncoding encoding) {
    return registry.create<Interface>(model.name, model.parameters, encoding);
}

Mesh mesh_of(const Object& object, const Shape& shape, const SurfaceModels& surface) {
    const PointNeeds needs = surface.needs();
    try {
        return build_mesh(shape, {.uv = needs.uv, .derivatives = needs.derivatives}, object.placement, *surface.shading);
    } catch (const std::bad_alloc&) {
        throw Error(ExitCode::failure, fmt::format("object {}: not enough memory for its triangles", object.label));
    } catch (const std::exception& problem) {
        throw Error(ExitCode::failure,
                    fmt::format("object {}: plugin shape/{}: {}", object.label, object.shape.name, problem.what()));
    }
}

}  // namespace

CompiledScene compile(const Scene& scene, Registry& registry, Diagnostics& diagnostics) {
    const ColorEncoding encoding = scene.image.color_management;
    CompiledScene compiled{.observer = scene.observer, .image = scene.image, .lights = {}, .objects = {}};
    for (const LightSource& light : scene.lights) {
        compiled.lights.push_back({light.model.name, made<Light>(registry, light.model, encoding)});
    }
    for (const Object& object : scene.objects) {
        SurfaceModels surface{.color = decoded(object.color, encoding),
                              .shading_plugin = object.shading.name,
                              .shading = made<ShadingModel>(registry, object.shading, encoding),
                              .reflection_plugin = object.reflection.name,
                              .reflection = made<ReflectionModel>(registry, object.reflection, encoding)};
        const auto shape = made<Shape>(registry, object.shape, encoding);
        Mesh mesh = mesh_of(object, *shape, surface);
        if (!mesh.closed) {
            diagnostics.warning(object.place,
                                fmt::format("object {} is not closed ({} open edge{}), so it is drawn from both sides",
                                            object.label, mesh.open_edges, mesh.open_edges == 1 ? "" : "s"));
        }
        compiled.objects.push_back({object.label, std::move(mesh), std::move(surface)});
    }
    return compiled;
}

}  // namespace candela
