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

import :reported;
import :scene_textures;
import candela.api;
import candela.geometry;
import candela.plugins;
import candela.raster;
import candela.scene;
import candela.shading;
import candela.util;

namespace candela {

namespace {

/// A scene and what was built from it, from which the next frame takes whatever is unchanged.
struct Before {
    Scene scene;
    RenderScene built;
    std::vector<std::vector<std::string>> warnings;  // of the objects' shapes
};

/// Whether nothing has moved, so that the constraints hold as before. Objects are compared elsewhere.
bool is_placed_as(const Scene& a, const Scene& b) {
    const auto is_same_light = [](const LightSource& x, const LightSource& y) {
        return x.label == y.label && position_of(x) == position_of(y);
    };
    // Warnings are reported again in every frame.
    return a.constraints == b.constraints && a.constraints.overlap != Overlap::warn && a.room == b.room &&
           a.observer.position == b.observer.position &&
           std::ranges::equal(a.lights, b.lights, is_same_light);
}

class SceneBuilder {
  public:
    /// Moves reusable parts out of `before`, if it is not null.
    SceneBuilder(const SceneDraft& draft, Registry& registry, Diagnostics& diagnostics, int threads,
                 const Progress& progress, Before* before = nullptr)
        : scene_(draft.scene),
          registry_(registry),
          diagnostics_(diagnostics),
          threads_(threads),
          progress_(progress),
          before_(before != nullptr &&
                          before->scene.image.color_management == draft.scene.image.color_management &&
                          before->scene.objects.size() == draft.scene.objects.size()
                      ? before
                      : nullptr),
          warnings_(draft.scene.objects.size()) {
        tell();
        built_.observer = scene_.observer;
        built_.image = scene_.image;
        built_.shadow_pattern = scene_.shadows.pattern;
        if (draft.is_complete) make_models();
        if (draft.is_complete) make_textures();
        if (draft.is_complete) make_environment();
        if (draft.is_complete) make_mirror_images();
        place_shapes();
        if (!has_kept_triangles() || !is_placed_as(before_->scene, scene_)) check(draft);
    }

    bool has_kept_triangles() const { return before_ != nullptr && kept_ == scene_.objects.size(); }
    std::vector<std::vector<std::string>> take_warnings() { return std::move(warnings_); }

    std::optional<RenderScene> take() {
        if (diagnostics_.has_errors()) return std::nullopt;
        with_threads(
            threads_,
            [&] {
                for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
                    finish(i);
                    count_step();
                }
                make_trees();
                make_occlusion();
            },
            rough_milliseconds());
        if (diagnostics_.has_errors()) return std::nullopt;
        return std::move(built_);
    }

  private:
    /// `part` of the next step has been done already.
    void tell(double part = 0) const {
        constexpr std::size_t k_steps = 3;  // per object
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
    void guarded(const std::string& whose, const SourceLocation& place, Work work) {
        reported(diagnostics_, whose, place, work);
    }

    template <class Interface>
    std::unique_ptr<Interface> made(const Model& model) {
        return registry_.create<Interface>(model.name, model.parameters, encoding());
    }

    void make_models() {
        for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
            const LightSource& light = scene_.lights[i];
            if (before_ != nullptr && i < before_->scene.lights.size() &&
                before_->scene.lights[i].model == light.model) {
                built_.lights.push_back(std::move(before_->built.lights[i]));
                continue;
            }
            guarded("light " + light.label.text(), light.place,
                    [&] { built_.lights.push_back(render_light(registry_, light.model, encoding())); });
        }
        for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
            const Object& object = scene_.objects[i];
            RenderObject& solid = built_.objects.emplace_back();
            solid.label = object.label.text();
            if (const Object* const old = object_before(i);
                old != nullptr && old->color == object.color && old->color_texture == object.color_texture &&
                old->normal_map == object.normal_map && old->shading == object.shading &&
                old->reflection == object.reflection && old->textures == object.textures &&
                old->common == object.common) {
                solid.surface = std::move(before_->built.objects[i].surface);
                continue;
            }
            guarded("object " + object.label.text(), object.place, [&] {
                SurfaceModels surface;
                surface.color = decoded(object.color, encoding());
                set_common(object.common, surface);
                surface.set_shading(registry_, object.shading, encoding());
                surface.set_reflection(registry_, object.reflection, encoding());
                solid.surface = std::move(surface);
            });
        }
    }

    void set_common(const CommonMaterial& material, SurfaceModels& surface) {
        surface.emission =
            material.emission_strength *
            (material.has_texture("emission") ? Rgb{1, 1, 1} : decoded(material.emission, encoding()));
        surface.occlusion = material.occlusion;
        surface.opacity = material.opacity;
        surface.opacity_cutoff = material.opacity_cutoff;
    }

    void make_textures() {
        SceneTextures textures(registry_, diagnostics_, encoding());
        for (std::size_t i = 0; before_ != nullptr && i < scene_.objects.size(); ++i) {
            textures.keep(before_->built.objects[i].surface);
            textures.keep(built_.objects[i].surface);  // moved from before
        }
        for (std::size_t i = 0; i < scene_.objects.size(); ++i)
            textures.expect(scene_.objects[i], built_.objects[i].surface);
        textures.read(threads_);
        for (std::size_t i = 0; i < scene_.objects.size(); ++i)
            textures.make(scene_.objects[i], built_.objects[i].surface);
    }

    void make_environment() {
        const auto shown = std::ranges::find_if(scene_.lights, &LightSource::is_background);
        if (shown != scene_.lights.end())
            return show(static_cast<std::size_t>(shown - scene_.lights.begin()));
        // Whatever the exposure, the background is shown as it is written.
        const float exposure = exposure_factor(scene_.observer.exposure);
        const Rgb background = decoded(scene_.image.background, encoding());
        built_.environment = EnvironmentMap(exposure == 1 ? background : 1 / exposure * background);
        if (scene_.image.environment.empty()) return;
        if (before_ != nullptr && before_->scene.image.environment == scene_.image.environment &&
            std::ranges::none_of(before_->scene.lights, &LightSource::is_background)) {
            built_.environment = std::move(before_->built.environment);
            return;
        }
        guarded("environment", scene_.image.environment_place, [&] {
            built_.environment = read_environment(scene_.image.environment, registry_, encoding());
        });
    }

    /// Makes a light the environment.
    void show(std::size_t index) {
        if (index >= built_.lights.size()) return;  // an error has been reported
        const LightSource& source = scene_.lights[index];
        if (before_ != nullptr && index < before_->scene.lights.size() &&
            before_->scene.lights[index].is_background &&
            before_->scene.lights[index].model == source.model) {
            built_.environment = std::move(before_->built.environment);
            return;
        }
        const auto* const sky = extension_of<SkySource>(*built_.lights[index].light);
        if (sky == nullptr) {
            diagnostics_.error(source.background_place,
                               fmt::format("light {}: light/{} cannot be the background, because it does not "
                                           "come from everywhere",
                                           source.label.text(), source.model.name),
                               "remove 'background', or use a light such as environment or sky");
            return;
        }
        guarded("light " + source.label.text(), source.place,
                [&] { built_.environment = environment_of(*sky); });
    }

    /// Finds what glossy surfaces mirror.
    void make_mirror_images() {
        if (std::ranges::none_of(built_.objects, [](const RenderObject& solid) {
                return solid.surface.glossy_reflection != nullptr;
            }))
            return;
        for (std::size_t i = 0; i < built_.lights.size() && i < scene_.lights.size(); ++i) {
            const LightSource& light = scene_.lights[i];
            guarded("light " + light.label.text(), light.place, [&] { built_.lights[i].find_radiance(); });
        }
    }

    /// Runs what a shape plugin or a shading model does to an object.
    template <class Work>
    void guarded(const Object& object, PluginKind kind, const std::string& plugin, Work work) {
        guarded("object " + object.label.text(), object.place, [&] {
            try {
                work();
            } catch (const std::bad_alloc&) {
                throw Error(ErrorCategory::failure, "not enough memory for its triangles");
            } catch (...) {
                rethrow_as_plugin_error(kind, plugin);
            }
        });
    }

    /// Whether triangles that are flat need no normals at their vertices.
    static bool takes_facets(const SurfaceModels& surface) {
        const ShadingNeeds& needs = surface.shading_needs;
        return needs.default_vertex_normals && surface.shading->shading_rate() != ShadingRate::vertex &&
               !needs.triangle && !surface.needs().derivatives;
    }

    void place_shapes() {
        placed_.resize(scene_.objects.size());
        const auto has_surface = [&](std::size_t i) {
            return i < built_.objects.size() && built_.objects[i].surface.shading != nullptr;
        };
        // All are created before the first is placed, so that shapes that read the same file read it once.
        std::vector<std::unique_ptr<Shape>> shapes(placed_.size());
        for (std::size_t i = 0; i < placed_.size(); ++i) {
            const Object& object = scene_.objects[i];
            if (has_surface(i) && keep(i, built_.objects[i].surface.needs())) continue;
            guarded(object, PluginKind::shape, object.shape.name,
                    [&] { shapes[i] = made<Shape>(object.shape); });
        }
        for (std::size_t i = 0; i < placed_.size(); ++i) {
            const Object& object = scene_.objects[i];
            const PointNeeds needs = has_surface(i) ? built_.objects[i].surface.needs() : PointNeeds{};
            if (shapes[i] != nullptr) {
                const std::vector<VertexChannel> channels = vertex_channels_of(object);
                guarded(object, PluginKind::shape, object.shape.name, [&] {
                    placed_[i] = place(*shapes[i],
                                       {.uv = needs.uv,
                                        .derivatives = needs.derivatives,
                                        .color = true,
                                        .facets = has_surface(i) && takes_facets(built_.objects[i].surface),
                                        .color_management = encoding(),
                                        .channels = channels},
                                       object.transform, [this](double part) { tell(part); });
                });
                shapes[i].reset();  // frees a file's triangles before the next file is read
                if (placed_[i]) warnings_[i] = placed_[i]->warnings;
                if (has_surface(i) && built_.objects[i].surface.needs().footprint && placed_[i] &&
                    placed_[i]->mesh.u.empty())
                    require_texture_coordinates(object, diagnostics_);
            }
            say_once(object, warnings_[i]);
            count_step();
        }
    }

    const Object* object_before(std::size_t i) const {
        return before_ != nullptr ? &before_->scene.objects[i] : nullptr;
    }

    /// Takes an object's triangles from before, if they are the same and have what its models need.
    bool keep(std::size_t i, const PointNeeds& needs) {
        const Object& object = scene_.objects[i];
        const Object* const old = object_before(i);
        if (old == nullptr || old->shape != object.shape || old->transform != object.transform ||
            old->color != object.color || old->encloses != object.encloses ||
            old->shading != object.shading || old->common.is_see_through() != object.common.is_see_through())
            return false;
        RenderObject& solid = before_->built.objects[i];
        if (solid.mesh.u.empty() == needs.uv || solid.mesh.dpdu.empty() == needs.derivatives ||
            !std::ranges::equal(vertex_channels_of(object), vertex_channels_of(*old)))
            return false;
        built_.objects[i].mesh = std::move(solid.mesh);
        built_.objects[i].tree = std::move(solid.tree);
        warnings_[i] = std::move(before_->warnings[i]);
        ++kept_;
        return true;
    }

    /// A hundred objects may come from one file.
    void say_once(const Object& object, const std::vector<std::string>& warnings) {
        for (const std::string& warning : warnings) {
            if (!said_.insert(warning).second) continue;
            diagnostics_.warning(object.place, fmt::format("object {}: {}", object.label.text(), warning));
        }
    }

    void check(const SceneDraft& draft) {
        std::vector<SurfaceView> surfaces(placed_.size());
        for (std::size_t i = 0; i < placed_.size(); ++i) {
            const Mesh* const mesh = placed_[i]                  ? &placed_[i]->mesh
                                     : i < built_.objects.size() ? &built_.objects[i].mesh
                                                                 : nullptr;
            if (mesh == nullptr || mesh->vertex_count() == 0) continue;
            surfaces[i] = {mesh->position.span(), mesh->vertex_count(), mesh->indices, mesh->open_edges == 0};
        }
        check_constraints(draft, surfaces, diagnostics_, [this] { count_step(); });
    }

    /// An estimate of the time that one thread takes to finish all objects.
    double rough_milliseconds() const {
        constexpr double k_normals = 2e-5, k_tree = 1e-3;  // per triangle
        double sum = 0;
        for (std::size_t i = 0; i < placed_.size(); ++i) {
            if (!placed_[i]) continue;
            const double each = needs_tree(built_.objects[i]) ? k_normals + k_tree : k_normals;
            sum += each * static_cast<double>(placed_[i]->mesh.triangle_count());
        }
        return sum;
    }

    static bool needs_tree(const RenderObject& solid) {
        return solid.surface.environment_reflection != nullptr && !solid.tree;
    }

    void make_trees() {
        std::vector<RenderObject*> without;
        for (RenderObject& solid : built_.objects) {
            if (needs_tree(solid)) without.push_back(&solid);
        }
        parallel_for(without.size(), 1, [&](std::size_t first, std::size_t end) {
            for (std::size_t i = first; i < end; ++i) {
                const Mesh& mesh = without[i]->mesh;
                without[i]->tree.emplace(mesh.position.span(), mesh.vertex_count(), mesh.indices);
            }
        });
    }

    bool has_shadows() const {
        return scene_.shadows.enabled && std::ranges::any_of(scene_.lights, [](const LightSource& light) {
                   return light.casts_shadows || light.ambient_occlusion.rays > 0;
               });
    }

    bool is_transparent(std::size_t i) const {
        const SurfaceModels& surface = built_.objects[i].surface;
        return scene_.objects[i].transmits_light && surface.environment_reflection != nullptr &&
               surface.environment_reflection->transmittance(Rgb{1, 1, 1}, 0) != Rgb{};
    }

    /// Whether the occluders are those of before.
    bool is_occluded_as_before() const {
        if (!has_kept_triangles() || !before_->built.occlusion) return false;
        for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
            const Object &now = scene_.objects[i], &old = before_->scene.objects[i];
            if (now.casts_shadows != old.casts_shadows || now.transmits_light != old.transmits_light ||
                now.reflection != old.reflection ||
                now.common.is_see_through() != old.common.is_see_through())
                return false;
        }
        return true;
    }

    void make_occlusion() {
        for (std::size_t i = 0; i < built_.lights.size() && i < scene_.lights.size(); ++i) {
            built_.lights[i].casts_shadows = scene_.lights[i].casts_shadows;
            built_.lights[i].ambient_occlusion = scene_.lights[i].ambient_occlusion;
        }
        for (std::size_t i = 0; i < built_.objects.size(); ++i)
            built_.objects[i].receives_shadows = scene_.objects[i].receives_shadows;
        if (!has_shadows() || diagnostics_.has_errors()) return;
        if (is_occluded_as_before()) {
            built_.occlusion = std::move(before_->built.occlusion);
            return;
        }
        std::vector<Occluder> occluders;
        for (std::size_t i = 0; i < built_.objects.size(); ++i) {
            const Mesh& mesh = built_.objects[i].mesh;
            const Object& object = scene_.objects[i];
            occluders.push_back({.mesh = object.casts_shadows ? &mesh : nullptr,
                                 .is_solid = mesh.closed && !mesh.one_sided && !object.encloses,
                                 .is_transparent = is_transparent(i),
                                 .is_see_through = object.common.is_see_through() && !is_transparent(i)});
        }
        guarded("shadows", {}, [&] { built_.occlusion.emplace(occluders); });
    }

    void finish(std::size_t i) {
        const Object& object = scene_.objects[i];
        RenderObject& solid = built_.objects[i];
        if (placed_[i]) {
            guarded(object, PluginKind::shading, object.shading.name,
                    [&] { solid.mesh = with_normals(std::move(*placed_[i]), *solid.surface.shading); });
            multiply(solid.mesh.color, solid.surface.color);
        }
        if (object.encloses || object.common.is_see_through()) {
            solid.mesh.closed = solid.mesh.one_sided;  // otherwise also seen from inside
        } else if (!solid.mesh.closed) {
            diagnostics_.warning(
                object.place,
                fmt::format("object {} is not closed ({} open edge{}), so it is drawn from both sides",
                            object.label.text(), solid.mesh.open_edges,
                            solid.mesh.open_edges == 1 ? "" : "s"));
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
    int threads_;
    const Progress& progress_;
    std::size_t steps_done_ = 0;
    Before* before_;        // source of everything unchanged; null: nothing is
    std::size_t kept_ = 0;  // objects whose triangles were taken
    RenderScene built_;
    std::vector<std::optional<PlacedShape>> placed_;
    std::vector<std::vector<std::string>> warnings_;  // of the objects' shapes
    std::set<std::string> said_;
};

}  // namespace

std::optional<RenderScene> build(const SceneDraft& draft, Registry& registry, Diagnostics& diagnostics,
                                 int threads, const Progress& progress) {
    return SceneBuilder(draft, registry, diagnostics, threads, progress).take();
}

struct FrameBuilder::Kept {
    Registry& registry;
    std::optional<Before> before{};
    bool has_kept_triangles = false;
};

FrameBuilder::FrameBuilder(Registry& registry) : kept_(std::make_unique<Kept>(Kept{registry})) {}
FrameBuilder::FrameBuilder(FrameBuilder&&) noexcept = default;
FrameBuilder& FrameBuilder::operator=(FrameBuilder&&) noexcept = default;
FrameBuilder::~FrameBuilder() = default;

bool FrameBuilder::has_kept_triangles() const noexcept { return kept_->has_kept_triangles; }

const RenderScene* FrameBuilder::build(const SceneDraft& draft, Diagnostics& diagnostics, int threads) {
    // If this one throws, nothing of the previous frame is kept.
    std::optional<Before> before = std::exchange(kept_->before, std::nullopt);
    const Progress silent;
    SceneBuilder builder(draft, kept_->registry, diagnostics, threads, silent, before ? &*before : nullptr);
    kept_->has_kept_triangles = builder.has_kept_triangles();
    auto built = builder.take();
    if (!built) return nullptr;
    kept_->before = Before{draft.scene, *std::move(built), builder.take_warnings()};
    return &kept_->before->built;
}

std::optional<RenderScene> build(const Scene& scene, Registry& registry, Diagnostics& diagnostics,
                                 int threads) {
    return build(SceneDraft{.scene = scene}, registry, diagnostics, threads);
}

}  // namespace candela
