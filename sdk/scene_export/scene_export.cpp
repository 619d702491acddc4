#include "scene_export/scene_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene_export/abilities.h"
#include "scene_export/export_storage.h"
#include "scene_export/exported_textures.h"

import candela.api;
import candela.plugins;
import candela.raster;
import candela.scene;
import candela.shading;
import candela.util;

namespace candela {

namespace {

constexpr const char* k_no_kernel =
    "has no kernel, the text from which its mathematics is generated; programs can be generated only with "
    "models that have one";

/// Puts the models of one kind into a list, each once.
template <class Exported>
std::size_t put(std::vector<Exported>& list, const Exported& model) {
    const auto found = std::ranges::find(list, model.plugin, &Exported::plugin);
    if (found != list.end()) return static_cast<std::size_t>(found - list.begin());
    list.push_back(model);
    return list.size() - 1;
}

bool has_function(const PluginDescriptor& plugin, std::string_view name) {
    return std::ranges::any_of(plugin.kernel.functions,
                               [&](const KernelFunction& function) { return name == function.name; });
}

/// Fills a SceneExport.
class Exporter {
  public:
    Exporter(ExportStorage& to, const Scene& scene, const ExportRequest& request)
        : to_(to),
          registry_(to.registry),
          scene_(scene),
          request_(request),
          textures_(to, scene.image.color_management, request.abilities) {}

    void run() {
        to_.has_vertex_colors = request_.abilities.vertex_colors;
        set_image();
        for (const LightSource& light : scene_.lights) add(light);
        for (const Object& object : scene_.objects) add_models(object);
        for (const std::string& name : request_.extra_models) add_extra(name);
        find_radiance();
        to_.objects.reserve(scene_.objects.size());
        for (std::size_t i = 0; i < scene_.objects.size(); ++i) add(i);
        for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
            to_.exported_objects[i].shadings = to_.objects[i].shadings;
            to_.exported_objects[i].materials = to_.objects[i].materials;
            to_.exported_objects[i].textured_numbers = to_.objects[i].textured_numbers;
            if (to_.objects[i].normal_map) to_.exported_objects[i].normal_map = &*to_.objects[i].normal_map;
            to_.exported_objects[i].emission_numbers = to_.objects[i].emission_numbers;
            to_.exported_objects[i].color_numbers = to_.objects[i].color_numbers;
            to_.exported_objects[i].occlusion_numbers = to_.objects[i].occlusion_numbers;
            to_.exported_objects[i].opacity_numbers = to_.objects[i].opacity_numbers;
        }
        ExportedScene& result = to_.scene;
        result.title = to_.title.c_str();
        result.light_models = to_.light_models;
        result.lights = to_.lights;
        result.shadings = to_.shadings;
        result.reflections = to_.reflections;
        result.objects = to_.exported_objects;
        result.textures = to_.textures;
        result.needs_uv = !to_.textures.empty() ||
                          std::ranges::any_of(to_.shadings, [](const auto& s) { return s.needs.uv; }) ||
                          std::ranges::any_of(to_.reflections, [](const auto& r) { return r.needs.uv; });
        result.needs_derivatives =
            std::ranges::any_of(to_.objects, [](const auto& o) { return o.normal_map.has_value(); }) ||
            std::ranges::any_of(to_.reflections, [](const auto& r) { return r.needs.tangent; }) ||
            std::ranges::any_of(to_.shadings, [](const auto& s) { return s.needs.derivatives; });
        to_.connect_tables();
        result.geometry = &to_;
    }

  private:
    void set_image() {
        const ImageSettings& image = scene_.image;
        if (!image.environment.empty() && !request_.abilities.surroundings) {
            throw Error(ErrorCategory::failure,
                        "[image] environment: the background of a generated program is one colour, not an "
                        "environment map");
        }
        for (const LightSource& light : scene_.lights) {
            if (light.is_background && !request_.abilities.surroundings)
                throw Error(ErrorCategory::failure,
                            fmt::format("light {}: 'background' is set, but the background of a generated "
                                        "program is one colour; --set light.{}.background=false leaves the "
                                        "light as it is",
                                        light.label.text(),
                                        light.label.name.empty() ? fmt::format("{}", light.label.number)
                                                                 : light.label.name));
        }
        to_.title = request_.title;
        to_.environment = image.environment;
        for (const SamplePosition& s : sample_pattern(image.samples))
            to_.samples.push_back({static_cast<float>(s.x) / 16, static_cast<float>(s.y) / 16});
        to_.scene.image = {.width = image.width,
                           .height = image.height,
                           .samples = to_.samples,
                           .background = image.background,
                           .environment = to_.environment.c_str(),
                           .color_management = image.color_management,
                           .exposure = exposure_factor(scene_.observer.exposure),
                           .tone = image.tone};
        const bool is_exposed = to_.scene.image.exposure != 1;
        if ((is_exposed || image.tone != ToneCurve::none) && !request_.abilities.display)
            throw Error(ErrorCategory::failure,
                        fmt::format("{}: what this target makes shows intensities as they are; {}",
                                    is_exposed ? "[observer] exposure" : "[image] tone",
                                    is_exposed ? "set the lights' intensities instead"
                                               : "--tone none leaves it out"));
        if (scene_.shadows.enabled && !request_.abilities.shadows)
            throw Error(ErrorCategory::failure,
                        "[shadows]: objects cast no shadows in what this target makes; --no-shadows leaves "
                        "them out");
        to_.scene.has_shadows = scene_.shadows.enabled;
        to_.scene.shadows_vary = scene_.shadows.pattern == ShadowPattern::varied;
        to_.scene.room = {scene_.room.width, scene_.room.height, scene_.room.depth};
        const Observer observer = fitted(scene_.observer, image.width, image.height);
        to_.scene.observer = {.position = observer.position,
                              .look_at = observer.look_at,
                              .up = observer.up,
                              .projection = observer.projection,
                              .fov = observer.fov,
                              .height = observer.height,
                              .unfitted_fov = scene_.observer.fov,
                              .unfitted_height = scene_.observer.height};
    }

    template <class Interface>
    std::unique_ptr<Interface> made(const std::string& name, const ParamSet& values) {
        return registry_.create<Interface>(name, values, scene_.image.color_management);
    }

    /// The plugin of a model, whose kernel must have these functions if the target needs kernels.
    const PluginDescriptor& model(PluginKind kind, const std::string& name,
                                  const std::vector<const char*>& functions) {
        const PluginDescriptor& loaded = registry_.descriptor(kind, name);
        if (request_.abilities.models_without_kernel) return loaded;
        const std::string id = plugin_id(kind, name);
        if (loaded.kernel.text == nullptr)
            throw Error(ErrorCategory::failure, fmt::format("{} {}", id, k_no_kernel));
        for (const char* const function : functions) {
            if (has_function(loaded, function)) continue;
            throw Error(ErrorCategory::failure, fmt::format("{}: its kernel has no function {}_{}", id,
                                                            loaded.kernel.prefix, function));
        }
        return loaded;
    }

    const char* kept(std::string label) { return to_.labels.emplace_back(std::move(label)).c_str(); }
    const char* id_of(PluginKind kind, const std::string& name) { return kept(plugin_id(kind, name)); }

    void add(const LightSource& light) {
        RenderLight source = render_light(registry_, light.model, scene_.image.color_management);
        std::vector<const char*> functions;
        if (source.light->sample_count() > 0) functions.push_back("illuminate");
        if (source.has_ambient) functions.push_back("illuminate_ambient");
        const PluginDescriptor& loaded = model(PluginKind::light, light.model.name, functions);
        to_.lights.push_back({.label = kept(light.label.text()),
                              .model = put(to_.light_models, ExportedModel{&loaded, id_of(PluginKind::light,
                                                                                          light.model.name)}),
                              .values = to_.kept(loaded, light.model.parameters,
                                                 [&]() -> const Light* { return source.light.get(); }),
                              .casts_shadows = light.casts_shadows,
                              .ambient_occlusion_rays = light.ambient_occlusion.rays,
                              .ambient_occlusion_distance = light.ambient_occlusion.distance});
        if (source.data) {
            ExportedLight& to = to_.lights.back();
            to.ambient = source.data->ambient;
            to.punctual = to_.punctual.emplace_back(std::move(source.data->samples));
            to.is_data = true;
        }
        to_.sources.push_back(std::move(source));
    }

    /// Finds what glossy models mirror of the lights.
    void find_radiance() {
        if (std::ranges::none_of(to_.reflections, &ExportedReflection::is_glossy)) return;
        for (std::size_t i = 0; i < to_.sources.size(); ++i) {
            RenderLight& source = to_.sources[i];
            source.find_radiance();
            if (source.radiance == nullptr || source.radiance->density() <= 0) continue;
            to_.lights[i].radiance = {.size = source.radiance->size(),
                                      .density = source.radiance->density(),
                                      .texels = source.radiance->texels()};
        }
    }

    void add_shading(const std::string& name, const ParamSet& values) {
        const auto instance = made<ShadingModel>(name, values);
        ExportedShading exported;
        exported.plugin = &model(PluginKind::shading, name, {"normal"});
        exported.id = id_of(PluginKind::shading, name);
        exported.rate = instance->shading_rate();
        exported.needs = exported.plugin->shading_needs;
        if (exported.needs.triangle && !request_.abilities.triangle &&
            !request_.abilities.models_without_kernel) {
            throw Error(ErrorCategory::failure, fmt::format("{} reads the vertices of its triangle, "
                                                            "which this target's programs do not provide",
                                                            exported.id));
        }
        keep_name(to_.shadings, *exported.plugin, PluginKind::shading, name);
        put(to_.shadings, exported);
    }

    void add_reflection(const std::string& name, const ParamSet& values) {
        const auto instance = made<ReflectionModel>(name, values);
        ExportedReflection exported;
        exported.needs = registry_.descriptor(PluginKind::reflection, name).surface_needs;
        exported.shows_surroundings = extension_of<EnvironmentReflection>(*instance) != nullptr;
        if (exported.shows_surroundings && !request_.abilities.surroundings) {
            throw Error(ErrorCategory::failure,
                        fmt::format("{} shows what is behind and around an object by following rays "
                                    "through it; generated programs do not do that",
                                    plugin_id(PluginKind::reflection, name)));
        }
        exported.plugin = &model(PluginKind::reflection, name, {"reflect", "reflect_ambient"});
        exported.id = id_of(PluginKind::reflection, name);
        // Without a kernel, the target's own model takes its place.
        exported.is_glossy =
            extension_of<GlossyReflection>(*instance) != nullptr &&
            (exported.plugin->kernel.text == nullptr || has_function(*exported.plugin, "highlight_width"));
        keep_name(to_.reflections, *exported.plugin, PluginKind::reflection, name);
        put(to_.reflections, exported);
    }

    /// Remembers the name by which the registry knows a model, which may be a kernel file's. Throws Error for
    /// a second model with the names of another one's kernel functions.
    template <class Exported>
    void keep_name(const std::vector<Exported>& others, const PluginDescriptor& plugin, PluginKind kind,
                   const std::string& name) {
        to_.names[&plugin] = name;
        for (const Exported& other : others) {
            if (other.plugin == &plugin || std::string_view(other.plugin->name) != plugin.name) continue;
            throw Error(
                ErrorCategory::failure,
                fmt::format("the {} models '{}' and '{}' have kernel functions of the same names, which a "
                            "program cannot contain; rename one of them",
                            name_of(kind), other.id, plugin_id(kind, name)));
        }
    }

    void add_models(const Object& object) {
        try {
            add_shading(object.shading.name, object.shading.parameters);
            add_reflection(object.reflection.name, object.reflection.parameters);
        } catch (const Error& problem) {
            throw Error(problem.category(),
                        fmt::format("object {}: {}", object.label.text(), problem.what()));
        }
    }

    void add_default(PluginKind kind, const std::string& name) {
        const ParamSet values = registry_.parameters(kind, name);
        kind == PluginKind::shading ? add_shading(name, values) : add_reflection(name, values);
    }

    void add_extra(const std::string& name) {
        constexpr PluginKind k_kinds[] = {PluginKind::shading, PluginKind::reflection};
        if (is_kernel_file(name)) {
            const std::string file = absolute_model_name(name);
            return add_default(registry_.require_kernel(file).manifest.kind, file);
        }
        if (name == "all") {
            for (const PluginKind kind : k_kinds) {
                for (const std::string& each : registry_.names(kind)) {
                    try {
                        add_default(kind, each);
                    } catch (const Error&) {
                        continue;  // "all" means those that can be exported
                    }
                }
            }
            return;
        }
        bool is_known = false;
        std::vector<std::string> names;
        for (const PluginKind kind : k_kinds) {
            for (const std::string& each : registry_.names(kind)) {
                names.push_back(each);
                if (each != name && fmt::format("{}/{}", name_of(kind), each) != name) continue;
                add_default(kind, each);
                is_known = true;
            }
        }
        if (is_known) return;
        const std::string meant = suggestion(name, names);
        throw Error(ErrorCategory::bad_request,
                    fmt::format("no reflection or shading model is called '{}'{}{}", name,
                                kernel_file_hint(name), meant.empty() ? "" : "; " + meant),
                    meant.empty() ? Help{Help::Topic::all_plugins} : Help{});
    }

    /// The scene with that model for all objects, or nothing if it is invalid with it. Each model is
    /// requested once.
    const std::optional<Scene>& with(PluginKind kind, const std::string& name) {
        const auto at = with_.find({kind, name});
        if (at != with_.end()) return at->second;
        auto scene = request_.with_model ? request_.with_model(kind, name) : std::nullopt;
        if (scene && scene->objects.size() != scene_.objects.size()) scene.reset();
        return with_.emplace(std::pair(kind, name), std::move(scene)).first->second;
    }

    /// An object's values for a model that is not its own: those that `--shading` and `--reflection` would
    /// give it. If the scene is invalid with them, because the other model does not know a word of the
    /// object's own: the defaults.
    ParamSet values_for(PluginKind kind, const std::string& name, std::size_t index) {
        const auto& scene = with(kind, name);
        if (!scene) return registry_.parameters(kind, name);
        const Object& object = scene->objects[index];
        return kind == PluginKind::shading ? object.shading.parameters : object.reflection.parameters;
    }

    void add(std::size_t index) {
        const Object& object = scene_.objects[index];
        require_abilities(object, request_);
        auto& own = to_.objects.emplace_back();
        own.tessellator = made<Shape>(object.shape.name, object.shape.parameters);
        own.transform = object.transform;
        const bool has_opacity = request_.abilities.opacity && object.common.is_see_through();
        for (std::string& part : left_out_of(object, request_.abilities))
            to_.left_out.push_back(kept(std::move(part)));
        if (request_.abilities.second_uv || request_.abilities.vertex_channels)
            for (const VertexChannel& channel : vertex_channels_of(object))
                own.channels.push_back({kept(std::string(channel.attribute)), channel.channel});
        own.encloses = object.encloses || has_opacity;
        ExportedObject exported{
            .label = kept(name_in(object.label)),
            .color = object.color,
            .shape = {&registry_.descriptor(PluginKind::shape, object.shape.name),
                      id_of(PluginKind::shape, object.shape.name)},
            .shape_values =
                to_.kept(registry_.descriptor(PluginKind::shape, object.shape.name), object.shape.parameters,
                         [&]() -> const Shape* { return own.tessellator.get(); }),
            .transform = object.transform,
            .emission = object.common.emission,
            .emission_strength = object.common.emission_strength,
            .occlusion = object.common.occlusion,
            .opacity = has_opacity ? object.common.opacity : 1,
            .opacity_cutoff = has_opacity ? object.common.opacity_cutoff : 0,
            .casts_shadows = object.casts_shadows,
            .receives_shadows = object.receives_shadows,
            .transmits_light = object.transmits_light};
        textures_.add(object, own);
        // Not by their names: files with the same text are the same plugin.
        const PluginDescriptor& shading = registry_.descriptor(PluginKind::shading, object.shading.name);
        const PluginDescriptor& reflection =
            registry_.descriptor(PluginKind::reflection, object.reflection.name);
        for (std::size_t i = 0; i < to_.shadings.size(); ++i) {
            const std::string& name = to_.names.at(to_.shadings[i].plugin);
            const bool is_own = to_.shadings[i].plugin == &shading;
            if (is_own) exported.shading = i;
            own.shading_values.push_back(is_own ? object.shading.parameters
                                                : values_for(PluginKind::shading, name, index));
            own.shadings.push_back(to_.kept(*to_.shadings[i].plugin, own.shading_values.back(), [&] {
                return made<ShadingModel>(name, own.shading_values.back());
            }));
        }
        for (std::size_t i = 0; i < to_.reflections.size(); ++i) {
            const std::string& name = to_.names.at(to_.reflections[i].plugin);
            const bool is_own = to_.reflections[i].plugin == &reflection;
            if (is_own) exported.reflection = i;
            const ParamSet values =
                is_own ? object.reflection.parameters : values_for(PluginKind::reflection, name, index);
            own.materials.push_back(to_.kept(*to_.reflections[i].plugin, values,
                                             [&] { return made<ReflectionModel>(name, values); }));
        }
        to_.exported_objects.push_back(exported);
    }

    ExportStorage& to_;
    Registry& registry_;
    const Scene& scene_;
    const ExportRequest& request_;
    std::map<std::pair<PluginKind, std::string>, std::optional<Scene>> with_;
    ExportedTextures textures_;
};

}  // namespace

struct SceneExport::Storage final : ExportStorage {
    using ExportStorage::ExportStorage;
};

SceneExport::SceneExport(const Scene& scene, const ExportRequest& request, Registry& registry)
    : storage_(std::make_unique<Storage>(registry)) {
    Exporter(*storage_, scene, request).run();
}

SceneExport::SceneExport(SceneExport&&) noexcept = default;
SceneExport& SceneExport::operator=(SceneExport&&) noexcept = default;
SceneExport::~SceneExport() = default;

const ExportedScene& SceneExport::scene() const noexcept { return storage_->scene; }
std::span<const char* const> SceneExport::left_out() const noexcept { return storage_->left_out; }

}  // namespace candela
