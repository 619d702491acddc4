module;

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

module candela.exported_scene;

import candela.color;
import candela.diagnostics;
import candela.light;
import candela.mesh;
import candela.parallel;
import candela.parameters;
import candela.punctual;
import candela.raster;
import candela.reflection;
import candela.shading;
import candela.shape;
import candela.text;
import candela.texture;

namespace candela {

namespace {

constexpr const char* k_no_kernel =
    "has no kernel, the text that its mathematics is generated from; a program can only be generated with "
    "models that have one";

std::string name_in(const std::string& label) {
    const std::string_view name = name_of_label(label).value_or(label);
    // Targets write labels into comments and pages: a line break would end them.
    std::string shown;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        shown += byte < 0x20 || byte == 0x7f ? fmt::format("\\u{{{:x}}}", byte) : std::string(1, c);
    }
    return shown;
}

/// A value as a person writes it, in the form in which values cross to plugins.
ParamValue written_value(const Value& value, const Parameter& parameter) {
    ParamValue result;
    if (const auto* boolean = std::get_if<bool>(&value)) result.integer = *boolean ? 1 : 0;
    if (const auto* whole = std::get_if<std::int64_t>(&value))
        result.integer = static_cast<std::int32_t>(*whole);
    if (const auto* real = std::get_if<double>(&value)) result.number[0] = static_cast<float>(*real);
    if (const auto* vector = std::get_if<Vec3>(&value)) {
        result.number[0] = vector->x;
        result.number[1] = vector->y;
        result.number[2] = vector->z;
    }
    if (const auto* rows = std::get_if<Matrix>(&value)) std::ranges::copy(*rows, result.number);
    if (const auto* list = std::get_if<NumberList>(&value)) result.list = *list;
    if (const auto* text = std::get_if<std::string>(&value)) {
        if (parameter.type == ParamType::choice) {
            const auto at = std::ranges::find(parameter.choices, *text);
            result.integer = static_cast<std::int32_t>(at - parameter.choices.begin());
        } else {
            result.text = text->c_str();
        }
    }
    return result;
}

/// Whether a parameter is a table of the plugin's kernel, which has neither texts nor lists.
bool is_table(const PluginDescriptor& plugin, std::size_t parameter) {
    const ParamType type = plugin.parameters[parameter].type;
    return (type == ParamType::file || type == ParamType::numbers) &&
           std::ranges::find(plugin.kernel.members, parameter) != plugin.kernel.members.end();
}

bool has_tables(const PluginDescriptor& plugin) {
    return std::ranges::any_of(plugin.kernel.members,
                               [&](std::size_t parameter) { return is_table(plugin, parameter); });
}

/// Puts the models of one kind into a list, each once.
template <class Exported>
std::size_t put(std::vector<Exported>& list, const Exported& model) {
    const auto found = std::ranges::find(list, model.plugin, &Exported::plugin);
    if (found != list.end()) return static_cast<std::size_t>(found - list.begin());
    list.push_back(model);
    return list.size() - 1;
}

bool are_equal(const Vec3Arrays& a, const Vec3Arrays& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

bool has_function(const PluginDescriptor& plugin, std::string_view name) {
    return std::ranges::any_of(plugin.kernel.functions,
                               [&](const KernelFunction& function) { return name == function.name; });
}

}  // namespace

/// What stands behind the spans of an ExportedScene.
struct SceneExport::Storage final : ExportedGeometry {
    struct Object {
        std::string label;
        std::unique_ptr<Shape> tessellator;
        Transform transform;
        std::vector<ExportedValues> shadings, materials;
        std::vector<ParamSet> shading_values;
    };

    explicit Storage(Registry& plugins) : registry(plugins) {}

    ExportedMesh in_object_space(std::size_t object) override {
        placed = place(*objects[object].tessellator, request(true), {});
        require_no_colors(object);
        return view_of(placed.mesh, placed);
    }

    ExportedMesh in_world_space(std::size_t object) override {
        normal_sets.clear();
        normals_of.clear();
        const Object& from = objects[object];
        placed = place(*from.tessellator, request(scene.needs_uv), from.transform);
        require_no_colors(object);
        make_face_normals(placed.mesh);
        std::vector<std::unique_ptr<ShadingModel>> models;
        for (std::size_t i = 0; i < scene.shadings.size(); ++i)
            models.push_back(registry.create<ShadingModel>(
                scene.shadings[i].plugin->name, from.shading_values[i], scene.image.color_management));
        std::vector<Vec3Arrays> all(models.size());
        parallel_for(models.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) all[i] = vertex_normals(placed, *models[i]);
        });
        for (Vec3Arrays& normals : all) {
            const auto same = std::ranges::find_if(
                normal_sets, [&](const Vec3Arrays& set) { return are_equal(set, normals); });
            normals_of.push_back(static_cast<std::size_t>(same - normal_sets.begin()));
            if (same == normal_sets.end()) normal_sets.push_back(std::move(normals));
        }
        normals_view.clear();
        for (const Vec3Arrays& set : normal_sets) normals_view.push_back(set.span());
        ExportedMesh view = view_of(placed.mesh, placed);
        view.normals = normals_view;
        view.normals_of = normals_of;
        return view;
    }

    MeshRequest request(bool needs_uv) const {
        return {.uv = needs_uv,
                .derivatives = scene.needs_derivatives,
                .color = true,
                .color_management = scene.image.color_management};
    }

    /// Unless the target can express them.
    void require_no_colors(std::size_t object) const {
        if (has_vertex_colors || placed.mesh.color.empty()) return;
        throw Error(ErrorCategory::failure,
                    fmt::format("object {} has a colour at each vertex, which this target cannot express; "
                                "vertex_colors = false leaves them out",
                                scene.objects[object].label));
    }

    bool has_default_normals(std::size_t object, std::size_t shading) override {
        struct Default final : ShadingModel {
            ShadingRate shading_rate() const noexcept override { return {}; }
            void normals(const ShadingPointBatch&, const Vec3Span&) const override {}
        };
        const Object& from = objects[object];
        const auto model = registry.create<ShadingModel>(
            scene.shadings[shading].plugin->name, from.shading_values[shading], scene.image.color_management);
        const Mesh expected = build_mesh(*from.tessellator, {}, from.transform, Default());
        const Mesh actual = build_mesh(*from.tessellator, {}, from.transform, *model);
        return std::ranges::equal(expected.vertices, actual.vertices, {}, &MeshVertex::normal,
                                  &MeshVertex::normal);
    }

    static ExportedMesh view_of(const Mesh& mesh, const PlacedShape& shape) {
        const auto span_of = [](const Vec3Arrays& arrays) {
            return arrays.empty() ? ConstVec3Span{} : arrays.span();
        };
        return {.vertex_count = mesh.vertex_count(),
                .indices = mesh.indices,
                .position = mesh.position.span(),
                .authored_normal = span_of(shape.authored_normal),
                .smooth_group = shape.smooth_group,
                .uv = mesh.u.empty() ? ConstVec2Span{} : ConstVec2Span{mesh.u.data(), mesh.v.data()},
                .color = span_of(mesh.color),
                .dpdu = span_of(mesh.dpdu),
                .dpdv = span_of(mesh.dpdv),
                .closed = mesh.closed};
    }

    /// The values of a set, which is kept as long as they are.
    ExportedValues kept(const ParamSet& values) {
        const ParamSet& set = sets.emplace_back(values);
        std::vector<ParamValue> written;
        for (std::size_t i = 0; i < set.schema().size(); ++i)
            written.push_back(set.get(i) ? written_value(*set.get(i), set.schema()[i]) : ParamValue{});
        return {.written = numbers.emplace_back(std::move(written)),
                .delivered = numbers.emplace_back(set.delivered(scene.image.color_management))};
    }

    /// The same of a plugin whose kernel may have tables: those of the instance that `make` makes.
    template <class Make>
    ExportedValues kept(const PluginDescriptor& plugin, const ParamSet& values, Make make) {
        const ExportedValues result = kept(values);
        if (!has_tables(plugin)) return result;
        const auto instance = make();
        std::vector<ParamValue>& delivered = numbers.back();
        for (std::size_t i = 0; i < delivered.size(); ++i) {
            if (!is_table(plugin, i)) continue;
            const std::span<const float> table = instance->table(i);
            if (!std::ranges::all_of(table, [](float x) { return std::isfinite(x); }))
                throw Error(ErrorCategory::failure,
                            fmt::format("plugin {}/{}: the table of '{}' has a number that is not finite",
                                        name_of(plugin.kind), plugin.name, plugin.parameters[i].name));
            put_table(table, delivered[i]);
        }
        return result;
    }

    void put_table(std::span<const float> table, ParamValue& value) {
        const auto same = std::ranges::search(tables, table);
        const auto first = static_cast<std::size_t>(same.begin() - tables.begin());
        if (same.empty()) tables.insert(tables.end(), table.begin(), table.end());
        // As many as programs count exactly with floats.
        if (tables.size() > std::size_t{1} << 24)
            throw Error(ErrorCategory::failure,
                        "the tables of the scene's models have more than 16777216 numbers, for which "
                        "generated programs have no room");
        value.integer = static_cast<std::int32_t>(table.empty() ? 0 : first);
        placed_tables.push_back({&value, table.size()});
    }

    /// When all are there, and stay where they are.
    void connect_tables() {
        for (const PlacedTable& placed_table : placed_tables) {
            ParamValue& value = *placed_table.value;
            value.list = std::span<const float>(tables).subspan(static_cast<std::size_t>(value.integer),
                                                                placed_table.size);
        }
        scene.tables = tables;
    }

    struct PlacedTable {
        ParamValue* value;
        std::size_t size;
    };

    Registry& registry;
    bool has_vertex_colors = false;  // the target's ability
    std::string title, environment;
    std::vector<ExportedSample> samples;
    std::deque<ParamSet> sets;                    // whose texts the values point into
    std::deque<std::vector<ParamValue>> numbers;  // a deque, so that what is there stays where it is
    std::deque<std::string> labels;
    std::vector<float> tables;
    std::vector<PlacedTable> placed_tables;
    std::vector<ExportedModel> light_models;
    std::vector<ExportedLight> lights;
    std::deque<std::vector<PunctualLight>> punctual;  // which the lights point into
    std::vector<ExportedShading> shadings;
    std::vector<ExportedReflection> reflections;
    std::vector<ExportedObject> exported_objects;
    std::vector<Object> objects;
    std::deque<std::shared_ptr<const MipMap>> mip_maps;  // which the textures point into
    std::deque<std::vector<ExportedTextureLevel>> levels;
    std::vector<ExportedTexture> textures;
    ExportedScene scene;

    // Of the mesh that was asked for last:
    PlacedShape placed;
    std::vector<Vec3Arrays> normal_sets;
    std::vector<ConstVec3Span> normals_view;
    std::vector<std::size_t> normals_of;
};

namespace {

/// Fills a SceneExport.
template <class Storage>
class Exporter {
  public:
    Exporter(Storage& to, const Scene& scene, const ExportRequest& request)
        : to_(to), registry_(to.registry), scene_(scene), request_(request) {}

    void run() {
        to_.has_vertex_colors = request_.abilities.vertex_colors;
        set_image();
        for (const LightSource& light : scene_.lights) add(light);
        for (const Object& object : scene_.objects) add_models(object);
        for (const std::string& name : request_.extra_models) add_extra(name);
        to_.objects.reserve(scene_.objects.size());
        for (std::size_t i = 0; i < scene_.objects.size(); ++i) add(i);
        for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
            to_.exported_objects[i].shadings = to_.objects[i].shadings;
            to_.exported_objects[i].materials = to_.objects[i].materials;
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
                          std::ranges::any_of(to_.reflections, &ExportedReflection::needs_uv);
        result.needs_derivatives =
            std::ranges::any_of(to_.reflections, &ExportedReflection::needs_tangent) ||
            std::ranges::any_of(to_.shadings, [](const auto& s) { return s.needs.derivatives; });
        to_.connect_tables();
        result.geometry = &to_;
    }

  private:
    void set_image() {
        const ImageSettings& image = scene_.image;
        if (!image.environment.empty() && !request_.abilities.surroundings) {
            throw Error(ErrorCategory::failure,
                        "[image] environment: a generated program has a background of one colour, not a "
                        "picture all around");
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
                           .color_management = image.color_management};
        to_.scene.room = {scene_.room.width, scene_.room.height, scene_.room.depth};
        const Observer& observer = scene_.observer;
        to_.scene.observer = {.position = observer.position,
                              .look_at = observer.look_at,
                              .up = observer.up,
                              .projection = observer.projection,
                              .fov = observer.fov,
                              .height = observer.height};
    }

    template <class Interface>
    std::unique_ptr<Interface> made(const std::string& name, const ParamSet& values) {
        return registry_.template create<Interface>(name, values, scene_.image.color_management);
    }

    /// The plugin, which has been loaded.
    const PluginDescriptor& plugin(PluginKind kind, const std::string& name) {
        return *registry_.require(kind, name).descriptor;
    }

    /// Likewise, of a model whose kernel has these functions where the target needs kernels.
    const PluginDescriptor& model(PluginKind kind, const std::string& name,
                                  const std::vector<const char*>& functions) {
        const PluginDescriptor& loaded = plugin(kind, name);
        if (request_.abilities.models_without_kernel) return loaded;
        const std::string id = fmt::format("{}/{}", name_of(kind), name);
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

    void add(const LightSource& light) {
        const auto made_light = made<Light>(light.model.name, light.model.parameters);
        std::vector<const char*> functions;
        if (made_light->sample_count() > 0) functions.push_back("illuminate");
        if (made_light->has_ambient()) functions.push_back("illuminate_ambient");
        const PluginDescriptor& loaded = model(PluginKind::light, light.model.name, functions);
        to_.lights.push_back({.label = kept(light.label),
                              .model = put(to_.light_models, ExportedModel{&loaded}),
                              .values = to_.kept(loaded, light.model.parameters,
                                                 [&]() -> const Light* { return made_light.get(); })});
        add_data(*made_light, to_.lights.back());
    }

    /// What a light says of itself.
    void add_data(const Light& from, ExportedLight& to) {
        std::vector<PunctualLight> samples(static_cast<std::size_t>(from.sample_count()));
        for (std::size_t i = 0; i < samples.size(); ++i)
            if (!from.describe(static_cast<int>(i), samples[i])) return;
        Rgb ambient{};
        if (from.has_ambient() && !from.describe_ambient(ambient)) return;
        to.ambient = ambient;
        to.punctual = to_.punctual.emplace_back(std::move(samples));
        to.is_data = true;
    }

    void add_shading(const std::string& name, const ParamSet& values) {
        const auto instance = made<ShadingModel>(name, values);
        ExportedShading exported;
        exported.plugin = &model(PluginKind::shading, name, {"normal"});
        exported.rate = instance->shading_rate();
        exported.needs = instance->needs();
        if (exported.needs.triangle && !request_.abilities.triangle &&
            !request_.abilities.models_without_kernel) {
            throw Error(ErrorCategory::failure,
                        fmt::format("shading/{} sees the vertices of its triangle, which the programs of "
                                    "this target do not show to a shading model",
                                    name));
        }
        put(to_.shadings, exported);
    }

    void add_reflection(const std::string& name, const ParamSet& values) {
        const auto instance = made<ReflectionModel>(name, values);
        ExportedReflection exported;
        exported.needs_tangent = instance->needs_tangent();
        exported.needs_position = instance->needs_position();
        exported.needs_uv = instance->needs_uv();
        exported.shows_surroundings = instance->shows_surroundings();
        if (exported.shows_surroundings && !request_.abilities.surroundings) {
            throw Error(
                ErrorCategory::failure,
                fmt::format(
                    "reflection/{} shows what is behind and around an object, for which rays are followed "
                    "through it; generated programs do not do that",
                    name));
        }
        exported.plugin = &model(PluginKind::reflection, name, {"reflect", "reflect_ambient"});
        put(to_.reflections, exported);
    }

    void add_models(const Object& object) {
        try {
            add_shading(object.shading.name, object.shading.parameters);
            add_reflection(object.reflection.name, object.reflection.parameters);
        } catch (const Error& problem) {
            throw Error(problem.category(), fmt::format("object {}: {}", object.label, problem.what()));
        }
    }

    void add_default(PluginKind kind, const std::string& name) {
        const ParamSet values = registry_.parameters(kind, name);
        kind == PluginKind::shading ? add_shading(name, values) : add_reflection(name, values);
    }

    void add_extra(const std::string& name) {
        constexpr PluginKind k_kinds[] = {PluginKind::shading, PluginKind::reflection};
        if (name == "all") {
            for (const PluginKind kind : k_kinds) {
                for (const std::string& each : registry_.names(kind)) {
                    try {
                        add_default(kind, each);
                    } catch (const Error&) {
                        continue;  // "all" are those that can be exported
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
                    fmt::format("no reflection or shading model is called '{}'{}", name,
                                meant.empty() ? "" : "; " + meant),
                    meant.empty() ? Help{Help::Topic::all_plugins} : Help{});
    }

    /// The scene with that model for all objects, or nothing where it is not valid so. Each model is asked
    /// for once.
    const std::optional<Scene>& with(PluginKind kind, const std::string& name) {
        const auto at = with_.find({kind, name});
        if (at != with_.end()) return at->second;
        auto scene = request_.with_model ? request_.with_model(kind, name) : std::nullopt;
        if (scene && scene->objects.size() != scene_.objects.size()) scene.reset();
        return with_.emplace(std::pair(kind, name), std::move(scene)).first->second;
    }

    /// An object's values for a model that is not its own: what `--shading` and `--reflection` would give it.
    /// Where the scene is not valid with them, because a word of its own model means nothing to the other:
    /// the defaults.
    ParamSet values_for(PluginKind kind, const std::string& name, std::size_t index) {
        const auto& scene = with(kind, name);
        if (!scene) return registry_.parameters(kind, name);
        const Object& object = scene->objects[index];
        return kind == PluginKind::shading ? object.shading.parameters : object.reflection.parameters;
    }

    /// The number of an object's texture; objects share them.
    std::size_t texture_of(const Object& object) {
        if (object.color_texture.empty()) return ExportedObject::k_no_texture;
        if (!request_.abilities.textures)
            throw Error(ErrorCategory::failure,
                        fmt::format("object {} has a texture, which this target cannot express; leave out "
                                    "color_texture",
                                    object.label));
        for (std::size_t i = 0; i < to_.textures.size(); ++i)
            if (to_.textures[i].file == object.color_texture) return i;
        const auto& mip_map = to_.mip_maps.emplace_back(
            read_texture(object.color_texture, registry_, scene_.image.color_management).mip_map);
        auto& levels = to_.levels.emplace_back();
        for (const MipMap::Level& level : mip_map->levels()) {
            const auto texels =
                static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height);
            levels.push_back(
                {level.width, level.height, mip_map->texels().subspan(4 * level.first, 4 * texels)});
        }
        to_.textures.push_back({kept(object.color_texture), levels});
        return to_.textures.size() - 1;
    }

    void add(std::size_t index) {
        const Object& object = scene_.objects[index];
        auto& own = to_.objects.emplace_back();
        own.tessellator = made<Shape>(object.shape.name, object.shape.parameters);
        own.transform = object.transform;
        ExportedObject exported{
            .label = kept(name_in(object.label)),
            .color = object.color,
            .shape = {&plugin(PluginKind::shape, object.shape.name)},
            .shape_values = to_.kept(plugin(PluginKind::shape, object.shape.name), object.shape.parameters,
                                     [&]() -> const Shape* { return own.tessellator.get(); }),
            .transform = object.transform,
            .color_texture = texture_of(object),
            .color_texture_repeats = object.color_texture_wrap == TextureWrap::repeat};
        for (std::size_t i = 0; i < to_.shadings.size(); ++i) {
            const std::string name = to_.shadings[i].plugin->name;
            const bool is_own = name == object.shading.name;
            if (is_own) exported.shading = i;
            own.shading_values.push_back(is_own ? object.shading.parameters
                                                : values_for(PluginKind::shading, name, index));
            own.shadings.push_back(to_.kept(*to_.shadings[i].plugin, own.shading_values.back(), [&] {
                return made<ShadingModel>(name, own.shading_values.back());
            }));
        }
        for (std::size_t i = 0; i < to_.reflections.size(); ++i) {
            const std::string name = to_.reflections[i].plugin->name;
            const bool is_own = name == object.reflection.name;
            if (is_own) exported.reflection = i;
            const ParamSet values =
                is_own ? object.reflection.parameters : values_for(PluginKind::reflection, name, index);
            own.materials.push_back(to_.kept(*to_.reflections[i].plugin, values,
                                             [&] { return made<ReflectionModel>(name, values); }));
        }
        to_.exported_objects.push_back(exported);
    }

    Storage& to_;
    Registry& registry_;
    const Scene& scene_;
    const ExportRequest& request_;
    std::map<std::pair<PluginKind, std::string>, std::optional<Scene>> with_;
};

}  // namespace

SceneExport::SceneExport(const Scene& scene, const ExportRequest& request, Registry& registry)
    : storage_(std::make_unique<Storage>(registry)) {
    Exporter<Storage>(*storage_, scene, request).run();
}

SceneExport::SceneExport(SceneExport&&) noexcept = default;
SceneExport& SceneExport::operator=(SceneExport&&) noexcept = default;
SceneExport::~SceneExport() = default;

const ExportedScene& SceneExport::scene() const noexcept { return storage_->scene; }

}  // namespace candela
