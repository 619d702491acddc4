module;

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

module candela.scene;

import :fields;
import :document;
import :models;
import :photometry;
import :reading;
import :tables;
import :textures;
import :vocabulary;
import candela.api;
import candela.plugins;
import candela.util;

namespace candela {

namespace {

class Reader {
  public:
    Reader(const SceneRequest& request, const MergedDocument& document, Registry& registry,
           Diagnostics& diagnostics)
        : tables_(document, registry, diagnostics),
          registry_(registry),
          request_(request),
          diagnostics_(diagnostics),
          files_(document.files) {}

    SceneDraft read() {
        read_version();
        std::vector<std::string> keys = names_in(top_schema().parameters);
        for (const TableSchema& schema : scene_schema()) keys.push_back(schema.name);
        report_unknown_keys(
            tables_.root(), keys,
            {.where = "the scene", .help = {}, .place = tables_.whole(), .hint = hints_for("", registry_)},
            diagnostics_);
        draft_.files = files_;
        draft_.has_room = tables_.read(own_tables().room, scene_.room).are_valid();
        read_observer();
        read_image();
        tables_.read(own_tables().constraints, scene_.constraints);
        tables_.read(own_tables().shadows, scene_.shadows);
        each("light", [&](const TableNode& table, const SourceLocation& place, std::size_t i) {
            read_light(table, place, i);
        });
        ModelChooser models(request_, tables_);
        each("object", [&](const TableNode& table, const SourceLocation& place, std::size_t i) {
            read_object(table, place, i, models);
        });
        warn_if_empty();
        draft_.is_complete = !diagnostics_.has_errors();
        return std::move(draft_);
    }

  private:
    static const SourceLocation& place_of(const TableNode& table, std::string_view key,
                                          const SourceLocation& otherwise) {
        const TableNode::Entry* const entry = table.find(key);
        // NOLINTNEXTLINE(bugprone-return-const-ref-from-parameter): callers copy it at once
        return entry != nullptr ? entry->node.place : otherwise;
    }

    void read_version() {
        const TableNode::Entry* const version = tables_.root().find("version");
        if (version == nullptr) {
            diagnostics_.error(tables_.whole(), "the scene has no version", "write: version = 1");
            return;
        }
        const auto* const number = std::get_if<std::int64_t>(&version->node.value);
        if (number == nullptr) {
            diagnostics_.error(version->node.place, fmt::format("'version' is {}; expected the integer 1",
                                                                description(version->node)));
        } else if (*number != 1) {
            diagnostics_.error(
                version->node.place,
                fmt::format("this Candela does not support version {} of the scene file", *number),
                "it reads version 1");
        }
    }

    void read_observer() {
        draft_.has_observer = false;
        if (tables_.root().find("observer") == nullptr) {
            diagnostics_.error(tables_.whole(), "the scene has no [observer]",
                               "write: [observer] with position and look_at");
            return;
        }
        Observer& observer = scene_.observer;
        const TableValues values = tables_.read(own_tables().observer, observer);
        // A unit vector is preserved exactly, so that a written scene reads back as the same scene.
        if (std::abs(length(observer.up) - 1) >= 1e-6f) observer.up = normalized(observer.up);
        const TableNode* const table = tables_.single("observer");
        if (table == nullptr) return;
        draft_.has_observer = values.is_valid("position");
        if (values.are_valid({"position", "look_at", "up"})) check_view(*table);
        if (values.is_valid("projection")) warn_of_unused(*table);
    }

    /// Whether the observer's view is well defined.
    void check_view(const TableNode& table) {
        const Observer& observer = scene_.observer;
        const SourceLocation& look_at = table.find("look_at")->node.place;
        const Vec3 view = normalized(observer.look_at - observer.position);
        if (view == Vec3{}) {
            diagnostics_.error(look_at, "the observer is at the point it looks at",
                               "position and look_at must differ");
        } else if (length(cross(view, observer.up)) < 1e-6f) {
            const TableNode::Entry* const up = table.find("up");
            diagnostics_.error(up != nullptr ? up->node.place : look_at,
                               "'up' is parallel to the viewing direction",
                               "choose another 'up', such as [0, 0, -1] when looking straight down");
        }
    }

    void warn_of_unused(const TableNode& table) {
        const bool perspective = scene_.observer.projection == Projection::perspective;
        for (const Field<Observer>& field : own_tables().observer.fields()) {
            const TableNode::Entry* const entry = table.find(field.parameter.name);
            if (entry == nullptr || field.has_no_effect == nullptr || !field.has_no_effect(scene_.observer))
                continue;
            diagnostics_.warning(entry->key_place,
                                 fmt::format("'{}' has no effect in a{} view", entry->key,
                                             perspective ? " perspective" : "n orthographic"));
        }
    }

    void read_image() {
        tables_.read(own_tables().image, scene_.image);
        const TableNode* const table = tables_.single("image");
        draft_.image_place = tables_.context_of("image").place;
        for (const char* const key : {"width", "height"}) {
            if (table != nullptr && table->find(key) != nullptr)
                draft_.image_place = table->find(key)->node.place;
        }
        if (table == nullptr || table->find("environment") == nullptr) return;
        if (const TableNode::Entry* const unused = table->find("background"))
            diagnostics_.warning(unused->key_place, "'background' has no effect with an environment");
    }

    template <class Visit>
    void each(const std::string& name, Visit visit) {
        const TableNode::Entry* const entry = tables_.root().find(name);
        if (entry == nullptr) return;
        const ArrayNode* const all = entry->node.array();
        if (all == nullptr ||
            !std::ranges::all_of(*all, [](const Node& node) { return node.table() != nullptr; })) {
            diagnostics_.error(entry->key_place,
                               fmt::format("'{}' is {}; expected tables, each headed {}", name,
                                           description(entry->node), schema_of(name).title));
            return;
        }
        for (std::size_t i = 0; i < all->size(); ++i) visit(*(*all)[i].table(), (*all)[i].place, i);
    }

    /// Reports a name that is already taken.
    Label label_of(const std::string& kind, const TableNode& table, std::size_t index) {
        const TableNode::Entry* const entry = table.find("name");
        const auto* const name = entry != nullptr ? std::get_if<std::string>(&entry->node.value) : nullptr;
        if (name == nullptr || name->empty()) return {.number = index};
        const auto [before, is_new] = names_.try_emplace(kind + ' ' + *name, entry->node.place);
        if (!is_new) {
            const SourceLocation& first = before->second;
            diagnostics_.error(entry->node.place, fmt::format("another {} is called '{}', at {}:{}:{}", kind,
                                                              *name, first.file, first.line, first.column));
        }
        return {.name = *name, .number = index};
    }

    /// As much of the label as fits into a message.
    static std::string short_text(const Label& label) {
        return Label{.name = std::string(shortened(label.name)), .number = label.number}.text();
    }

    /// Reads a plugin named by `type` with its parameters, which are next to the table's own keys.
    std::optional<TableValues> read_typed(const std::string& table_name, PluginKind kind,
                                          const TableNode& table, const ParamSet& own, TableContext context,
                                          std::vector<std::string> more_keys) {
        if (!has(own, "type")) return std::nullopt;
        const PluginFile* const plugin =
            tables_.known(kind, text(own, "type"), table.find("type")->node.place);
        if (plugin == nullptr) return std::nullopt;
        context.help = {Help::Topic::plugin, plugin_id(kind, text(own, "type"))};
        context.hint = hints_for(table_name, registry_);
        const std::vector<std::string> keys = names_in(
            plugin->manifest.parameters, names_in(schema_of(table_name).parameters, std::move(more_keys)));
        report_unknown_keys(table, keys, context, diagnostics_);
        return read_parameters(table, plugin->schema, context, diagnostics_, plugin->manifest.relations);
    }

    void read_light(const TableNode& table, const SourceLocation& place, std::size_t index) {
        LightSource light{.label = label_of("light", table, index),
                          .model = {},
                          .place = place,
                          .position_place = place_of(table, "position", place),
                          .background_place = place};
        const TableContext context{fmt::format("[[light]] {}", short_text(light.label)),
                                   {Help::Topic::plugins_of_kind, "light"},
                                   place};
        const TableValues own = read_parameters(table, own_tables().light.schema(), context, diagnostics_);
        own_tables().light.assign(&table, own.set, light);
        auto values = read_typed("light", PluginKind::light, table, own.set, context, {});
        if (light.ambient_occlusion.rays > 0) warn_without_ambient(table, light);
        if (light.is_background) check_background(light);
        // Its position can be checked whatever else is wrong with it.
        if (!values || !values->is_valid("position")) return;
        light.model.parameters = std::move(values->set);
        const PluginFile& plugin = *registry_.find(PluginKind::light, light.model.name);
        if (values->are_valid()) apply_unit(table, plugin, light);
        if (own.is_valid("temperature") && light.temperature > 0) apply_temperature(table, light);
        scene_.lights.push_back(std::move(light));
    }

    void check_background(const LightSource& light) {
        if (!background_light_.empty())
            diagnostics_.error(light.background_place, fmt::format("light {} is the background already; "
                                                                   "expected one light with 'background'",
                                                                   background_light_));
        background_light_ = light.label.text();
        if (!scene_.image.environment.empty())
            diagnostics_.warning(
                scene_.image.environment_place,
                fmt::format("'environment' has no effect: light {} is the background", background_light_));
    }

    /// Keeps the author's text of an intensity with a unit; in a cone, a flux makes more of it.
    static void apply_unit(const TableNode& table, const PluginFile& plugin, LightSource& light) {
        ParamSet& values = light.model.parameters;
        const std::size_t index = values.index_of("intensity");
        const TableNode::Entry* const entry = table.find("intensity");
        const auto* const text = entry != nullptr ? std::get_if<std::string>(&entry->node.value) : nullptr;
        if (text == nullptr || index == values.schema().size() ||
            values.schema()[index].notation == Notation::plain)
            return;
        light.written["intensity"] = toml_text(*text);
        if (notation_of(plugin.manifest, values.schema()[index]) != Notation::cone ||
            !photometric_from(*text)->is_flux())
            return;
        const double factor = cone_factor(std::get<double>(values.get("inner_angle")),
                                          std::get<double>(values.get("outer_angle")));
        values.set(index, factor * std::get<double>(values.get("intensity")));
    }

    /// Multiplies the light's colour by that of a black body. Light that is too bright for a colour goes into
    /// its intensity.
    void apply_temperature(const TableNode& table, LightSource& light) {
        const SourceLocation& place = table.find("temperature")->node.place;
        if (light.temperature < k_lowest_temperature) {
            diagnostics_.error(place,
                               fmt::format("'temperature' is {} K; expected {} to {} K, or 0 for none",
                                           light.temperature, k_lowest_temperature, k_highest_temperature));
            return;
        }
        ParamSet& values = light.model.parameters;
        const std::size_t color = values.index_of("color"), intensity = values.index_of("intensity");
        const std::size_t none = values.schema().size();
        if (color == none || intensity == none || values.schema()[color].type != ParamType::color ||
            values.schema()[intensity].type != ParamType::real) {
            diagnostics_.warning(place, fmt::format("'temperature' has no effect: light/{} has no color and "
                                                    "intensity to multiply",
                                                    light.model.name));
            return;
        }
        const auto& own_color = std::get<Vec3>(*values.get(color));
        const double own_intensity = std::get<double>(*values.get(intensity));
        const ColorEncoding encoding = scene_.image.color_management;
        const Rgb own = decoded(own_color, encoding), black = blackbody_color(light.temperature);
        const Rgb tinted{own.r * black.r, own.g * black.g, own.b * black.b};
        const float brightest = std::max({tinted.r, tinted.g, tinted.b});
        if (!(brightest > 0)) return;
        light.written.try_emplace("color", toml_text(own_color, ParamType::color));
        light.written.try_emplace("intensity", toml_text(own_intensity));
        const auto channel = [&](float x) {
            const float share = x / brightest;
            return 255 * (encoding == ColorEncoding::srgb ? linear_to_srgb(share) : share);
        };
        values.set(color, Vec3{channel(tinted.r), channel(tinted.g), channel(tinted.b)});
        values.set(intensity, double{brightest} * own_intensity);
    }

    void warn_without_ambient(const TableNode& table, const LightSource& light) {
        const PluginFile* const plugin = registry_.find(PluginKind::light, light.model.name);
        if (plugin == nullptr || plugin->manifest.has_ambient) return;
        diagnostics_.warning(
            table.find("ambient_occlusion_rays")->key_place,
            fmt::format("'ambient_occlusion_rays' has no effect: light/{} has no ambient part",
                        light.model.name));
    }

    void read_object(const TableNode& whole, const SourceLocation& place, std::size_t index,
                     ModelChooser& models) {
        Object object;
        object.label = label_of("object", whole, index);
        object.place = object.position_place = place;
        const std::size_t errors = diagnostics_.error_count();
        const TableContext context{fmt::format("[[object]] {}", short_text(object.label)),
                                   {Help::Topic::plugins_of_kind, "shape"},
                                   place};
        TableNode without_texture;
        const TableNode::Entry* const color = whole.find("color");
        const bool has_texture = color != nullptr && color->node.table() != nullptr;
        if (has_texture) {
            without_texture = whole;
            object.color_texture = models.take_color_texture(without_texture, context.where);
        }
        const TableNode& table = has_texture ? without_texture : whole;
        const TableValues own = read_parameters(table, own_tables().object.schema(), context, diagnostics_);
        own_tables().object.assign(&table, own.set, object);
        if (object.color_texture) object.color = {255, 255, 255};
        object.normal_map = normal_map_in(table, "object " + object.label.text(), diagnostics_);
        auto shape = read_typed("object", PluginKind::shape, table, own.set, context,
                                {"material", "normal_map", "bump_map"});
        object.shading = models.shading_for(table);
        models.set_reflection(object, table, short_text(object.label));
        if (!shape) return;
        // Its triangles can be checked whatever else is wrong with it.
        const bool has_known_triangles = own.are_valid({"position", "rotation", "scale", "encloses"}) &&
                                         shape->are_valid() && !shape->breaks_relation;
        if (diagnostics_.error_count() != errors && !has_known_triangles) return;
        object.shape.parameters = std::move(shape->set);
        scene_.objects.push_back(std::move(object));
    }

    void warn_if_empty() {
        if (diagnostics_.has_errors()) return;
        if (scene_.objects.empty()) {
            diagnostics_.warning(tables_.whole(),
                                 "the scene has no objects: the picture shows only the background");
        } else if (scene_.lights.empty() && std::ranges::none_of(scene_.objects, [](const Object& object) {
                       return object.common.emits();
                   })) {
            diagnostics_.warning(tables_.whole(), "the scene has no lights: every object is black");
        }
    }

    SceneTables tables_;
    Registry& registry_;
    const SceneRequest& request_;
    Diagnostics& diagnostics_;
    const std::vector<std::filesystem::path>& files_;
    SceneDraft draft_;
    Scene& scene_ = draft_.scene;
    std::map<std::string, SourceLocation> names_;
    std::string background_light_;
};

void add_files(const Model& model, std::vector<std::filesystem::path>& files) {
    for (std::size_t i = 0; i < model.parameters.schema().size(); ++i) {
        const auto& value = model.parameters.get(i);
        if (model.parameters.schema()[i].type != ParamType::file || !value) continue;
        if (const auto& file = std::get<std::string>(*value); !file.empty()) files.emplace_back(file);
    }
}

}  // namespace

std::vector<std::filesystem::path> input_files(const SceneDraft& draft) {
    std::vector<std::filesystem::path> files = draft.files;
    const Scene& scene = draft.scene;
    if (!scene.image.environment.empty()) files.emplace_back(scene.image.environment);
    for (const LightSource& light : scene.lights) add_files(light.model, files);
    for (const Object& object : scene.objects) {
        const auto add_picture = [&](const ParameterTexture& texture) {
            if (!texture.file.empty()) files.emplace_back(texture.file);
        };
        if (object.color_texture) add_picture(*object.color_texture);
        for (const auto* const textures : {&object.textures, &object.common.textures})
            std::ranges::for_each(*textures, add_picture);
        if (object.normal_map) files.emplace_back(object.normal_map->file);
        for (const Model* const model : {&object.shape, &object.shading, &object.reflection})
            add_files(*model, files);
    }
    return files;
}

SceneDraft read_draft(const SceneRequest& request, const MergedDocument& document, Registry& registry,
                      Diagnostics& diagnostics) {
    return Reader(request, document, registry, diagnostics).read();
}

std::optional<Scene> read_scene(const SceneRequest& request, Registry& registry, Diagnostics& diagnostics) {
    auto draft = draft_scene(request, registry, diagnostics);
    if (!draft || !draft->is_complete) return std::nullopt;
    return std::move(draft->scene);
}

}  // namespace candela
