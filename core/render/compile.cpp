// From a scene to meshes, lights and models.
module;

#include <fmt/format.h>

#include <exception>
#include <memory>
#include <new>
#include <optional>
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

Mesh mesh_of(const Object& object, const Shape& shape, const SurfaceModels& surface) {
    const PointNeeds needs = surface.needs();
    try {
        return build_mesh(shape, {.uv = needs.uv, .derivatives = needs.derivatives}, object.placement,
                          *surface.shading);
    } catch (const std::bad_alloc&) {
        throw Error(ExitCode::failure, "there is not enough memory for its triangles");
    } catch (...) {
        rethrow_as_plugin_error(PluginKind::shape, object.shape.name);
    }
}

class Compiler {
  public:
    Compiler(const Scene& scene, Registry& registry, Diagnostics& diagnostics)
        : encoding_(scene.image.color_management), registry_(registry), diagnostics_(diagnostics) {
        compiled_.observer = scene.observer;
        compiled_.image = scene.image;
        for (const LightSource& light : scene.lights) {
            guarded(fmt::format("light {}", light.label), light.place, [&] { add(light); });
        }
        for (const Object& object : scene.objects) {
            guarded(fmt::format("object {}", object.label), object.place, [&] { add(object); });
        }
    }

    std::optional<CompiledScene> take() {
        if (diagnostics_.has_errors()) return std::nullopt;
        return std::move(compiled_);
    }

  private:
    template <class Work>
    void guarded(const std::string& whose, const SourcePlace& place, Work work) {
        try {
            work();
        } catch (const Error& problem) {
            diagnostics_.failure(place, fmt::format("{}: {}", whose, problem.what()));
        }
    }

    template <class Interface>
    std::unique_ptr<Interface> made(const Model& model) {
        return registry_.create<Interface>(model.name, model.parameters, encoding_);
    }

    void add(const LightSource& light) {
        compiled_.lights.push_back({light.model.name, made<Light>(light.model)});
    }

    void add(const Object& object) {
        SurfaceModels surface{.color = decoded(object.color, encoding_),
                              .shading_plugin = object.shading.name,
                              .shading = made<ShadingModel>(object.shading),
                              .reflection_plugin = object.reflection.name,
                              .reflection = made<ReflectionModel>(object.reflection)};
        const auto shape = made<Shape>(object.shape);
        Mesh mesh = mesh_of(object, *shape, surface);
        if (!mesh.closed) {
            diagnostics_.warning(
                object.place,
                fmt::format("object {} is not closed ({} open edge{}), so it is drawn from both sides",
                            object.label, mesh.open_edges, mesh.open_edges == 1 ? "" : "s"));
        }
        compiled_.objects.push_back({object.label, std::move(mesh), std::move(surface)});
    }

    ColorEncoding encoding_;
    Registry& registry_;
    Diagnostics& diagnostics_;
    CompiledScene compiled_;
};

}  // namespace

std::optional<CompiledScene> compile(const Scene& scene, Registry& registry, Diagnostics& diagnostics) {
    return Compiler(scene, registry, diagnostics).take();
}

}  // namespace candela
