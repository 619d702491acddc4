module;

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

module candela.render;

import candela.color;
import candela.constraints;
import candela.diagnostics;
import candela.environment;
import candela.fragments;
import candela.library;
import candela.light;
import candela.mesh;
import candela.parallel;
import candela.params;
import candela.reflection;
import candela.registry;
import candela.scene;
import candela.shading;
import candela.shape;

namespace candela {

namespace {

class Compiler {
  public:
    Compiler(const SceneDraft& draft, Registry& registry, Diagnostics& diagnostics, const Progress& progress)
        : scene_(draft.scene), registry_(registry), diagnostics_(diagnostics), progress_(progress) {
        tell();
        compiled_.observer = scene_.observer;
        compiled_.image = scene_.image;
        if (draft.is_complete) make_models();
        if (draft.is_complete) make_environment();
        place_shapes();
        check(draft);
    }

    std::optional<CompiledScene> take(int threads) {
        if (diagnostics_.has_errors()) return std::nullopt;
        double triangles = 0;
        for (const auto& placed : placed_) triangles += static_cast<double>(placed->mesh.triangle_count());
        constexpr double k_milliseconds = 2e-5;  // for a triangle's normals, by one thread
        with_threads(
            threads,
            [&] {
                for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
                    finish(i);
                    count_step();
                }
            },
            k_milliseconds * triangles);
        if (diagnostics_.has_errors()) return std::nullopt;
        return std::move(compiled_);
    }

  private:
    /// `part` of the next step has been done already.
    void tell(double part = 0) const {
        constexpr std::size_t k_steps = 3;  // that each object takes
        constexpr std::size_t k_parts = 1000;
        if (!progress_) return;
        const auto parts = static_cast<std::size_t>(k_parts * std::clamp(part, 0.0, 1.0));
        progress_(k_parts * steps_done_ + parts, k_parts * k_steps * scene_.objects.size());
    }
    void count_step() {
        ++steps_done_;
        tell();
    }

    template <class Work>
    void guarded(const std::string& whose, const SourcePlace& place, Work work) {
        try {
            work();
        } catch (const Error& problem) {
            const std::string message = fmt::format("{}: {}", whose, problem.what());
            problem.category() == ErrorCategory::invalid_scene ? diagnostics_.error(place, message)
                                                               : diagnostics_.failure(place, message);
        }
    }

    template <class Interface>
    std::unique_ptr<Interface> made(const Model& model) {
        return registry_.create<Interface>(model.name, model.parameters, encoding());
    }

    void make_models() {
        for (const LightSource& light : scene_.lights) {
            guarded("light " + light.label, light.place,
                    [&] { compiled_.lights.push_back({light.model.name, made<Light>(light.model)}); });
        }
        for (const Object& object : scene_.objects) {
            SolidObject& solid = compiled_.objects.emplace_back();
            solid.label = object.label;
            guarded("object " + object.label, object.place, [&] {
                solid.surface = {.color = decoded(object.color, encoding()),
                                 .shading_plugin = object.shading.name,
                                 .shading = made<ShadingModel>(object.shading),
                                 .reflection_plugin = object.reflection.name,
                                 .reflection = made<ReflectionModel>(object.reflection)};
            });
        }
    }

    void make_environment() {
        compiled_.environment = Environment(decoded(scene_.image.background, encoding()));
        if (scene_.image.environment.empty()) return;
        guarded("environment", scene_.image.environment_place, [&] {
            compiled_.environment = read_environment(scene_.image.environment, registry_, encoding());
        });
    }

    /// Runs what a shape plugin or a shading model does to an object.
    template <class Work>
    void guarded(const Object& object, PluginKind kind, const std::string& plugin, Work work) {
        guarded("object " + object.label, object.place, [&] {
            try {
                work();
            } catch (const std::bad_alloc&) {
                throw Error(ErrorCategory::failure, "there is not enough memory for its triangles");
            } catch (...) {
                rethrow_as_plugin_error(kind, plugin);
            }
        });
    }

    void place_shapes() {
        placed_.resize(scene_.objects.size());
        for (std::size_t i = 0; i < placed_.size(); ++i) {
            const Object& object = scene_.objects[i];
            const bool has_surface =
                i < compiled_.objects.size() && compiled_.objects[i].surface.shading != nullptr;
            const PointNeeds needs = has_surface ? compiled_.objects[i].surface.needs() : PointNeeds{};
            guarded(object, PluginKind::shape, object.shape.name, [&] {
                placed_[i] = place(*made<Shape>(object.shape),
                                   {.uv = needs.uv,
                                    .derivatives = needs.derivatives,
                                    .color = true,
                                    .color_management = encoding()},
                                   object.transform, [this](double part) { tell(part); });
            });
            if (placed_[i]) say_once(object, placed_[i]->warnings);
            count_step();
        }
    }

    /// A hundred objects may come from one file.
    void say_once(const Object& object, const std::vector<std::string>& warnings) {
        for (const std::string& warning : warnings) {
            if (!said_.insert(warning).second) continue;
            diagnostics_.warning(object.place, fmt::format("object {}: {}", object.label, warning));
        }
    }

    void check(const SceneDraft& draft) {
        std::vector<SurfaceView> surfaces(placed_.size());
        for (std::size_t i = 0; i < placed_.size(); ++i) {
            if (!placed_[i]) continue;
            const Mesh& mesh = placed_[i]->mesh;
            surfaces[i] = {mesh.position.span(), mesh.vertex_count(), mesh.indices, mesh.closed};
        }
        check_constraints(draft, surfaces, diagnostics_, [this] { count_step(); });
    }

    void finish(std::size_t i) {
        const Object& object = scene_.objects[i];
        SolidObject& solid = compiled_.objects[i];
        guarded(object, PluginKind::shading, object.shading.name,
                [&] { solid.mesh = with_normals(std::move(*placed_[i]), *solid.surface.shading); });
        multiply(solid.mesh.color, solid.surface.color);
        if (solid.surface.reflection->shows_surroundings())
            solid.tree.emplace(std::as_const(solid.mesh.position).span(), solid.mesh.vertex_count(),
                               solid.mesh.indices);
        if (object.encloses) {
            solid.mesh.closed = false;  // seen from within, too
        } else if (!solid.mesh.closed) {
            diagnostics_.warning(
                object.place,
                fmt::format("object {} is not closed ({} open edge{}), so it is drawn from both sides",
                            object.label, solid.mesh.open_edges, solid.mesh.open_edges == 1 ? "" : "s"));
        }
    }

    static void multiply(Vec3Arrays& colors, Rgb by) {
        for (float& red : colors.x) red *= by.r;
        for (float& green : colors.y) green *= by.g;
        for (float& blue : colors.z) blue *= by.b;
    }

    ColorEncoding encoding() const { return scene_.image.color_management; }

    const Scene& scene_;
    Registry& registry_;
    Diagnostics& diagnostics_;
    const Progress& progress_;
    std::size_t steps_done_ = 0;
    CompiledScene compiled_;
    std::vector<std::optional<PlacedShape>> placed_;
    std::set<std::string> said_;
};

}  // namespace

std::optional<CompiledScene> compile(const SceneDraft& draft, Registry& registry, Diagnostics& diagnostics,
                                     int threads, const Progress& progress) {
    return Compiler(draft, registry, diagnostics, progress).take(threads);
}

std::optional<CompiledScene> compile(const Scene& scene, Registry& registry, Diagnostics& diagnostics,
                                     int threads) {
    return compile(SceneDraft{.scene = scene}, registry, diagnostics, threads);
}

}  // namespace candela
