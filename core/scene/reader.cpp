// From one document to a checked scene.
module;

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

module candela.scene;

import candela.diagnostics;
import candela.document;
import candela.math;
import candela.params;
import candela.plugins;
import candela.validation;

namespace candela {

namespace {

constexpr std::string_view k_default_shading = "phong";
constexpr std::string_view k_default_reflection = "phong";

const TableSchema& schema_of(std::string_view table) {
    const auto all = scene_schema();
    return *std::ranges::find_if(all, [&](const TableSchema& s) { return s.name == table; });
}

float real(const ParamSet& set, std::string_view name) {
    return static_cast<float>(std::get<double>(set.get(name)));
}
int integer(const ParamSet& set, std::string_view name) {
    return static_cast<int>(std::get<std::int64_t>(set.get(name)));
}
Vec3 vector(const ParamSet& set, std::string_view name) { return std::get<Vec3>(set.get(name)); }
const std::string& text(const ParamSet& set, std::string_view name) {
    return std::get<std::string>(set.get(name));
}
bool has(const ParamSet& set, std::string_view name) { return set.get(set.index_of(name)).has_value(); }

class Reader {
  public:
    Reader(const SceneRequest& request, const MergedDocument& document, Registry& registry,
           Diagnostics& diagnostics)
        : request_(request),
          root_(document.root),
          whole_(document.place),
          registry_(registry),
          diagnostics_(diagnostics) {}

    Scene read() {
        read_version();
        report_unknown_keys(root_, top_level_keys(), {"the scene", "", whole_}, diagnostics_);
        read_room();
        read_observer();
        read_image();
        choose_models();
        each("light", [&](const TableNode& table, const SourcePlace& place, std::size_t i) {
            read_light(table, place, i);
        });
        each("object", [&](const TableNode& table, const SourcePlace& place, std::size_t i) {
            read_object(table, place, i);
        });
        warn_if_empty();
        return std::move(scene_);
    }

  private:
    static std::vector<std::string> top_level_keys() {
        std::vector<std::string> keys{"version", "include"};
        for (const TableSchema& schema : scene_schema()) keys.push_back(schema.name);
        return keys;
    }

    static std::vector<std::string> names_in(std::span<const Parameter> schema,
                                             std::vector<std::string> keys = {}) {
        for (const Parameter& p : schema) keys.push_back(p.name);
        return keys;
    }

    void read_version() {
        const TableNode::Entry* const version = root_.find("version");
        if (version == nullptr) {
            diagnostics_.error(whole_, "the scene has no version", "write: version = 1");
            return;
        }
        const auto* const number = std::get_if<std::int64_t>(&version->node.value);
        if (number == nullptr) {
            diagnostics_.error(
                version->node.place,
                fmt::format("'version' is {}; expected the whole number 1", description(version->node)));
        } else if (*number != 1) {
            diagnostics_.error(
                version->node.place,
                fmt::format("version {} of the scene file is not known to this Candela", *number),
                "this one reads version 1");
        }
    }

    /// A table that may stand once; null where it is missing or is something else, which is reported.
    const TableNode* single(const std::string& name) {
        const TableNode::Entry* const entry = root_.find(name);
        if (entry == nullptr) return nullptr;
        if (entry->node.table() == nullptr) {
            const std::string what =
                entry->node.array() != nullptr ? "a list: there may be only one" : description(entry->node);
            diagnostics_.error(entry->key_place, fmt::format("'{}' is {}; expected the table {}", name, what,
                                                             schema_of(name).title));
        }
        return entry->node.table();
    }

    TableContext context_of(const std::string& name) const {
        const TableNode::Entry* const entry = root_.find(name);
        return {schema_of(name).title, "", entry != nullptr ? entry->key_place : whole_};
    }

    /// All values of a table that has no plugin behind it.
    ParamSet read_plain(const std::string& name) {
        static const TableNode k_empty;
        const TableNode* const table = single(name);
        const TableContext context = context_of(name);
        const std::vector<Parameter>& parameters = schema_of(name).parameters;
        if (table != nullptr) report_unknown_keys(*table, names_in(parameters), context, diagnostics_);
        return read_parameters(table != nullptr ? *table : k_empty, parameters, context, diagnostics_);
    }

    void read_room() {
        const ParamSet values = read_plain("room");
        scene_.room = {real(values, "height"), real(values, "width"), real(values, "depth")};
    }

    void read_observer() {
        if (root_.find("observer") == nullptr) {
            diagnostics_.error(whole_, "the scene has no [observer]",
                               "write: [observer] with position and look_at");
            return;
        }
        const ParamSet values = read_plain("observer");
        Observer& observer = scene_.observer;
        observer.up = normalized(vector(values, "up"));
        observer.projection =
            text(values, "projection") == "orthographic" ? Projection::orthographic : Projection::perspective;
        observer.fov = real(values, "fov");
        observer.height = real(values, "height");
        const TableNode* const table = single("observer");
        if (table == nullptr || !has(values, "position") || !has(values, "look_at")) return;
        observer.position = vector(values, "position");
        observer.look_at = vector(values, "look_at");

        const SourcePlace& look_at = table->find("look_at")->node.place;
        const Vec3 view = normalized(observer.look_at - observer.position);
        if (view == Vec3{}) {
            diagnostics_.error(look_at, "the observer looks at the point where it is",
                               "position and look_at must differ");
        } else if (length(cross(view, observer.up)) < 1e-6f) {
            const TableNode::Entry* const up = table->find("up");
            diagnostics_.error(
                up != nullptr ? up->node.place : look_at,
                "'up' points the way the observer looks, so that no direction is up in the picture",
                "choose another 'up', such as [0, 0, -1] when looking straight down");
        }
        const bool perspective = observer.projection == Projection::perspective;
        if (const TableNode::Entry* const unused = table->find(perspective ? "height" : "fov")) {
            diagnostics_.warning(unused->key_place,
                                 fmt::format("'{}' has no effect in a{} view", unused->key,
                                             perspective ? " perspective" : "n orthographic"));
        }
    }

    void read_image() {
        const ParamSet values = read_plain("image");
        scene_.image = {.width = integer(values, "width"),
                        .height = integer(values, "height"),
                        .samples = integer(values, "samples"),
                        .background = vector(values, "background"),
                        .color_management = text(values, "color_management") == "none" ? ColorEncoding::none
                                                                                       : ColorEncoding::srgb};
    }

    /// The name in `model`, from the command line or from the table; empty where there is none.
    std::string named_model(const std::string& table_name, const std::optional<std::string>& override_name) {
        if (override_name) return *override_name;
        const TableNode* const table = single(table_name);
        if (table == nullptr) return {};
        const ParamSet values =
            read_parameters(*table, schema_of(table_name).parameters, context_of(table_name), diagnostics_);
        return has(values, "model") ? text(values, "model") : std::string();
    }

    /// Whether some object needs what [shading] or [reflection] would name.
    bool is_needed(const std::string& key) const {
        const TableNode::Entry* const objects = root_.find("object");
        if (objects == nullptr || objects->node.array() == nullptr) return false;
        return std::any_of(objects->node.array()->begin(), objects->node.array()->end(),
                           [&](const Node& object) {
                               return object.table() != nullptr && object.table()->find(key) == nullptr;
                           });
    }

    /// R12, R13: what is not named may be the default, if somebody says so.
    void choose_models() {
        shading_ = named_model("shading", request_.shading);
        reflection_ = named_model("reflection", request_.reflection);
        const bool no_shading = shading_.empty() && root_.find("shading") == nullptr && is_needed("shading");
        const bool no_reflection =
            reflection_.empty() && root_.find("reflection") == nullptr && is_needed("reflection");
        if (no_shading || no_reflection) {
            const std::string missing = no_shading && no_reflection ? "shading or reflection model"
                                        : no_shading                ? "shading model"
                                                                    : "reflection model";
            std::string defaults;
            if (no_shading) defaults += fmt::format("{} shading", k_default_shading);
            if (no_shading && no_reflection) defaults += " and ";
            if (no_reflection) defaults += fmt::format("{} reflection", k_default_reflection);
            const bool agreed = request_.use_defaults ||
                                (request_.ask && request_.ask(fmt::format("The scene names no {}. Use {}?",
                                                                          missing, defaults)));
            if (!agreed) {
                diagnostics_.error(
                    whole_, fmt::format("the scene names no {}", missing),
                    fmt::format("--defaults uses {}; --shading and --reflection name others", defaults));
                return;
            }
            if (no_shading) shading_ = k_default_shading;
            if (no_reflection) reflection_ = k_default_reflection;
        }
        read_shading_table();
        if (const TableNode* const table = single("reflection")) {
            report_unknown_keys(*table, names_in(schema_of("reflection").parameters),
                                {"[reflection]", "an object's material stands in [object.material]", whole_},
                                diagnostics_);
        }
        if (!reflection_.empty()) known(PluginKind::reflection, reflection_, place_of_model("reflection"));
    }

    SourcePlace place_of_model(const std::string& table_name) {
        const auto& override_name = table_name == "shading" ? request_.shading : request_.reflection;
        if (override_name) return {"--" + table_name, 0, 0, 0};
        const TableNode* const table = single(table_name);
        const TableNode::Entry* const entry = table != nullptr ? table->find("model") : nullptr;
        return entry != nullptr ? entry->node.place : whole_;
    }

    /// [shading] also holds the parameters of its model.
    void read_shading_table() {
        if (shading_.empty()) return;
        const PluginFile* const plugin = known(PluginKind::shading, shading_, place_of_model("shading"));
        const TableNode* const table = single("shading");
        if (plugin == nullptr || table == nullptr || request_.shading) return;
        const TableContext context{"[shading]", "candela describe " + plugin->manifest.id(),
                                   context_of("shading").place};
        report_unknown_keys(*table, names_in(plugin->manifest.parameters, {"model"}), context, diagnostics_);
        shading_parameters_ = read_with_relations(*table, *plugin, context);
    }

    /// The installed plugin of that name, or null, with a message at `place`.
    const PluginFile* known(PluginKind kind, const std::string& name, const SourcePlace& place) {
        const PluginFile* const plugin = registry_.find(kind, name);
        if (plugin != nullptr) return plugin;
        try {
            registry_.require(kind, name);
        } catch (const Error& problem) {
            diagnostics_.error(place, problem.what());
        }
        return nullptr;
    }

    ParamSet read_with_relations(const TableNode& table, const PluginFile& plugin,
                                 const TableContext& context) {
        ParamSet values = read_parameters(table, plugin.manifest.parameters, context, diagnostics_);
        check_relations(table, values, plugin.manifest.relations, context, diagnostics_);
        return values;
    }

    template <class Visit>
    void each(const std::string& name, Visit visit) {
        const TableNode::Entry* const entry = root_.find(name);
        if (entry == nullptr) return;
        const ArrayNode* const all = entry->node.array();
        const bool are_tables = all != nullptr && std::all_of(all->begin(), all->end(), [](const Node& node) {
                                    return node.table() != nullptr;
                                });
        if (!are_tables) {
            diagnostics_.error(entry->key_place,
                               fmt::format("'{}' is {}; expected tables, each headed {}", name,
                                           description(entry->node), schema_of(name).title));
            return;
        }
        for (std::size_t i = 0; i < all->size(); ++i) visit(*(*all)[i].table(), (*all)[i].place, i);
    }

    /// The name of a light or object for messages, and that no other of its kind has it.
    std::string label_of(const std::string& kind, const TableNode& table, std::size_t index) {
        const TableNode::Entry* const entry = table.find("name");
        const auto* const name = entry != nullptr ? std::get_if<std::string>(&entry->node.value) : nullptr;
        if (name == nullptr || name->empty()) return fmt::format("number {}", index);
        const auto [before, is_new] = names_.try_emplace(kind + ' ' + *name, entry->node.place);
        if (!is_new) {
            diagnostics_.error(entry->node.place,
                               fmt::format("another {} is called '{}', at {}:{}:{}", kind, *name,
                                           before->second.file, before->second.line, before->second.column));
        }
        return fmt::format("'{}'", *name);
    }

    void read_light(const TableNode& table, const SourcePlace& place, std::size_t index) {
        const std::string label = label_of("light", table, index);
        TableContext context{fmt::format("[[light]] {}", label), "candela list light", place};
        const std::vector<Parameter>& own = schema_of("light").parameters;
        const ParamSet common = read_parameters(table, own, context, diagnostics_);
        if (!has(common, "type")) return;
        const PluginFile* const plugin =
            known(PluginKind::light, text(common, "type"), table.find("type")->node.place);
        if (plugin == nullptr) return;
        context.manual = "candela describe " + plugin->manifest.id();
        report_unknown_keys(table, names_in(plugin->manifest.parameters, names_in(own)), context,
                            diagnostics_);
        scene_.lights.push_back(
            {label, {plugin->manifest.name, read_with_relations(table, *plugin, context)}, place});
    }

    void read_object(const TableNode& table, const SourcePlace& place, std::size_t index) {
        Object object;
        object.label = label_of("object", table, index);
        object.place = place;
        TableContext context{fmt::format("[[object]] {}", object.label), "candela list shape", place};
        const std::vector<Parameter>& own = schema_of("object").parameters;
        const ParamSet common = read_parameters(table, own, context, diagnostics_);
        object.placement = {vector(common, "position"), vector(common, "rotation"), vector(common, "scale")};
        object.color = vector(common, "color");
        if (has(common, "type")) {
            if (const PluginFile* const shape =
                    known(PluginKind::shape, text(common, "type"), table.find("type")->node.place)) {
                context.manual = "candela describe " + shape->manifest.id();
                const std::vector<std::string> keys =
                    names_in(shape->manifest.parameters, names_in(own, {std::string("material")}));
                report_unknown_keys(table, keys, context, diagnostics_);
                object.shape = {shape->manifest.name, read_with_relations(table, *shape, context)};
            }
        }
        object.shading = shading_for(table, common);
        object.reflection = reflection_for(table, common, object.label, place);
        scene_.objects.push_back(std::move(object));
    }

    Model shading_for(const TableNode& table, const ParamSet& common) {
        const std::string& named = text(common, "shading");
        const bool own = !named.empty() && !request_.shading;
        const std::string& name = own ? named : shading_;
        if (name.empty()) return {};
        if (own) {
            if (const PluginFile* const plugin =
                    known(PluginKind::shading, name, table.find("shading")->node.place)) {
                return {name, ParamSet(plugin->manifest.parameters)};
            }
            return {};
        }
        if (registry_.find(PluginKind::shading, name) == nullptr) return {};  // reported with [shading]
        return {name, shading_parameters_.value_or(registry_.parameters(PluginKind::shading, name))};
    }

    Model reflection_for(const TableNode& table, const ParamSet& common, const std::string& label,
                         const SourcePlace& place) {
        static const TableNode k_empty;
        const TableNode::Entry* const entry = table.find("material");
        if (entry != nullptr && entry->node.table() == nullptr) {
            diagnostics_.error(entry->node.place,
                               fmt::format("'material' is {}; expected the table [object.material]",
                                           description(entry->node)));
            return {};
        }
        const std::string& named = text(common, "reflection");
        const bool own = !named.empty() && !request_.reflection;
        const std::string& name = own ? named : reflection_;
        if (name.empty()) return {};
        const PluginFile* plugin = registry_.find(PluginKind::reflection, name);
        if (plugin == nullptr) {
            if (own) known(PluginKind::reflection, name, table.find("reflection")->node.place);
            return {};
        }
        const TableNode& material = entry != nullptr ? *entry->node.table() : k_empty;
        const TableContext context{fmt::format("[object.material] of {}", label),
                                   "candela describe " + plugin->manifest.id(),
                                   entry != nullptr ? entry->key_place : place};
        report_unknown_material_keys(material, *plugin, context);
        return {name, read_with_relations(material, *plugin, context)};
    }

    /// With --reflection, a material written for another model is no mistake: what the model in use does not
    /// know is left out.
    void report_unknown_material_keys(const TableNode& material, const PluginFile& plugin,
                                      const TableContext& context) {
        const std::vector<std::string> known_keys = names_in(plugin.manifest.parameters);
        TableNode unknown;
        for (const TableNode::Entry& entry : material.entries) {
            if (std::ranges::find(known_keys, entry.key) != known_keys.end()) continue;
            const std::vector<std::string> others = models_with(entry.key);
            if (others.empty()) {
                unknown.entries.push_back(entry);
            } else if (!request_.reflection) {
                diagnostics_.error(
                    entry.key_place,
                    fmt::format("{} has no parameter '{}', which {} {}", plugin.manifest.id(), entry.key,
                                fmt::join(others, ", "), others.size() == 1 ? "has" : "have"),
                    fmt::format("({})", context.manual));
            }
        }
        report_unknown_keys(unknown, known_keys, context, diagnostics_);
    }

    std::vector<std::string> models_with(const std::string& key) {
        std::vector<std::string> models;
        for (const PluginFile* plugin : registry_.list()) {
            const auto& parameters = plugin->manifest.parameters;
            if (plugin->manifest.kind == PluginKind::reflection &&
                std::ranges::any_of(parameters, [&](const Parameter& p) { return p.name == key; })) {
                models.push_back(plugin->manifest.id());
            }
        }
        return models;
    }

    void warn_if_empty() {
        if (diagnostics_.has_errors()) return;
        if (scene_.objects.empty()) {
            diagnostics_.warning(whole_,
                                 "the scene has no objects: the picture shows nothing but the background");
        } else if (scene_.lights.empty()) {
            diagnostics_.warning(whole_, "the scene has no lights: every object is black");
        }
    }

    const SceneRequest& request_;
    const TableNode& root_;
    SourcePlace whole_;
    Registry& registry_;
    Diagnostics& diagnostics_;
    Scene scene_;
    std::string shading_, reflection_;
    std::optional<ParamSet> shading_parameters_;
    std::map<std::string, SourcePlace> names_;
};

}  // namespace

std::optional<Scene> read_scene(const SceneRequest& request, Registry& registry, Diagnostics& diagnostics) {
    const auto document = gather(request, diagnostics);
    if (!document) return std::nullopt;
    Scene scene = Reader(request, *document, registry, diagnostics).read();
    if (diagnostics.has_errors()) return std::nullopt;
    return scene;
}

}  // namespace candela
