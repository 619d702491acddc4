// The scene file as a JSON Schema.
//
// Editors complete from the keys under "properties" and do not evaluate conditions. A table that names a
// plugin therefore lists the parameters of all plugins of that kind there. A definition, which a dependency
// on the naming key brings in, holds the parameters and constraints of that plugin alone.
module;

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "json/json.h"

module candela.schema;

import candela.plugins;
import candela.scene;

namespace candela {

namespace {

Json value_json(const Parameter& p) { return parse_json(value_schema(p)); }

std::string description_of(const Parameter& p) {
    // For a position, the expected value already mentions metres.
    const std::string unit = p.type == ParamType::point ? "" : unit_word(p);
    return fmt::format("{}{}{} ({})", p.meaning, unit.empty() ? "" : ", in ", unit, constraint_text(p));
}

void put_default(Json& schema, const Parameter& p) {
    const auto text = default_text(p);
    if (!text) return;
    const auto* const word = std::get_if<std::string>(&*p.default_value);
    schema["default"] = word != nullptr ? Json(*word) : parse_json(*text);
}

Json parameter_schema(const Parameter& p) {
    Json schema{{"description", description_of(p)}};
    schema.update(value_json(p));
    put_default(schema, p);
    return schema;
}

constexpr const char* k_texture = "texture";
constexpr const char* k_attribute = "attribute";

/// A value, or the tables that there may be instead.
Json textured(Json value) {
    Json choices = Json::array({std::move(value)});
    for (const char* const table : {k_texture, k_attribute})
        choices.push_back({{"$ref", fmt::format("#/definitions/{}", table)}});
    return choices;
}

/// The value of a plugin's parameter, or the texture that it may have instead.
Json value_json(const Manifest& m, const Parameter& p) {
    Json value = value_json(p);
    if (!takes_texture(m, p)) return value;
    return {{"anyOf", textured(std::move(value))}};
}

Json parameter_schema(const Manifest& m, const Parameter& p) {
    Json schema{{"description", description_of(p)}};
    schema.update(value_json(m, p));
    put_default(schema, p);
    return schema;
}

/// The value of a key, or the texture that it may have instead.
Json textured_schema(const Parameter& p) {
    Json schema = parameter_schema(p);
    return {{"description", schema["description"]},
            {"anyOf", textured(value_json(p))},
            {"default", schema["default"]}};
}

/// Adds the list of tables whose product the value may be.
Json with_product(Json textured) {
    Json factors = Json::array();
    for (const char* const table : {k_texture, k_attribute})
        factors.push_back({{"$ref", fmt::format("#/definitions/{}", table)}});
    textured["anyOf"].push_back({{"type", "array"}, {"items", {{"anyOf", factors}}}, {"minItems", 1}});
    return textured;
}

/// Adds the keys that every material has, unless its models have parameters of that name.
void add_common(PluginKind kind, Json& properties) {
    if (kind != PluginKind::reflection) return;
    for (const Parameter& p : material_schema().parameters)
        if (!properties.contains(p.name))
            properties[p.name] = p.name == "opacity" ? with_product(textured_schema(p))
                                 : takes_texture(p)  ? textured_schema(p)
                                                     : parameter_schema(p);
}

/// A list of values of the parameter's type.
Json list_schema(const Parameter& p) {
    return {{"description", p.meaning}, {"type", "array"}, {"items", value_json(p)}, {"uniqueItems", true}};
}

/// A list of pairs of a time and a value, whose type is that of the animated parameter.
Json timed_schema(const Parameter& p) {
    const Json pair{{"type", "array"},
                    {"items", {{{"type", "number"}}, Json::object()}},
                    {"minItems", 2},
                    {"maxItems", 2}};
    return {{"description", p.meaning}, {"type", "array"}, {"items", pair}, {"minItems", 1}};
}

Json required_in(std::span<const Parameter> parameters) {
    Json names = Json::array();
    for (const Parameter& p : parameters) {
        if (!p.default_value) names.push_back(p.name);
    }
    return names;
}

void put_unless_empty(Json& schema, const std::string& key, Json value) {
    if (!value.empty()) schema[key] = std::move(value);
}

/// A plugin, and its parameter of a certain name.
struct User {
    const Manifest* plugin;
    const Parameter* parameter;
};

template <class Function>
bool is_same_for_all(const std::vector<User>& users, Function function) {
    return std::ranges::all_of(users, [&](const User& user) {
        return function(*user.parameter) == function(*users.front().parameter);
    });
}

/// Whether all plugins have the same constraints on the value.
bool is_agreed(const std::vector<User>& users) {
    const User& first = users.front();
    return std::ranges::all_of(users, [&](const User& user) {
        return value_json(*user.plugin, *user.parameter) == value_json(*first.plugin, *first.parameter);
    });
}

/// The common constraints of all plugins that use a parameter of that name, and its meaning for each.
Json merged(const std::vector<User>& users) {
    std::vector<std::pair<std::string, std::string>> meanings;  // and the plugins with that meaning
    for (const auto& [plugin, parameter] : users) {
        const std::string meaning = description_of(*parameter);
        const auto same = std::ranges::find(meanings, meaning, [](const auto& pair) { return pair.first; });
        if (same == meanings.end()) {
            meanings.emplace_back(meaning, plugin->name);
        } else {
            same->second += ", " + plugin->name;
        }
    }
    std::vector<std::string> lines;
    for (const auto& [meaning, who] : meanings) lines.push_back(fmt::format("{}: {}", who, meaning));
    Json schema{{"description", fmt::format("{}", fmt::join(lines, "\n"))}};

    const Parameter& first = *users.front().parameter;
    const auto type_of = [](const Parameter& p) { return value_json(p)["type"]; };
    const bool may_have_texture =
        std::ranges::any_of(users, [](const User& u) { return takes_texture(*u.plugin, *u.parameter); });
    if (is_agreed(users)) {
        schema.update(value_json(*users.front().plugin, first));
    } else if (!may_have_texture && is_same_for_all(users, type_of)) {
        schema["type"] = type_of(first);
    }
    if (is_same_for_all(users, default_text)) put_default(schema, first);
    return schema;
}

class SchemaWriter {
  public:
    explicit SchemaWriter(std::span<const Manifest> installed) : installed_(with_notations(installed)) {}

    Json write() {
        Json root{
            {"$schema", "http://json-schema.org/draft-07/schema#"},
            {"title", "Candela scene"},
            {"description",
             "A scene for Candela, or a part of one: several files may be read as one scene, so neither "
             "'version' nor [observer] is required here, though each must appear exactly once across all "
             "files. "
             "'candela check' also finds errors that a JSON Schema cannot express."},
            {"type", "object"}};
        for (const Parameter& p : top_schema().parameters) {
            const bool is_list = std::ranges::find(top_schema().lists, p.name) != top_schema().lists.end();
            root["properties"][p.name] = is_list ? list_schema(p) : parameter_schema(p);
        }
        for (const TableSchema& table : scene_schema()) root["properties"][table.name] = schema_of(table);
        if (!all(PluginKind::reflection).empty()) {
            definitions_[k_texture] = schema_of(texture_schema());
            definitions_[k_attribute] = schema_of(vertex_attribute_schema());
        }
        root["additionalProperties"] = false;
        put_unless_empty(root, "dependencies", material_dependencies());
        put_unless_empty(root, "definitions", std::move(definitions_));
        return root;
    }

  private:
    std::vector<const Manifest*> all(PluginKind kind) const {
        std::vector<const Manifest*> found;
        for (const Manifest& m : installed_) {
            if (m.kind == kind) found.push_back(&m);
        }
        return found;
    }

    static std::string definition_name(const Manifest& m) {
        return fmt::format("{}-{}", name_of(m.kind), m.name);
    }
    static Json reference_to(const Manifest& m) { return {{"$ref", "#/definitions/" + definition_name(m)}}; }

    Json schema_of(const TableSchema& table) {
        Json properties = Json::object();
        std::vector<std::string> own;
        for (const Parameter& p : table.parameters) {
            const bool is_timed = std::ranges::find(table.timed, p.name) != table.timed.end();
            const bool may_have_texture = table.name == "object" && p.name == color_parameter().name &&
                                          !all(PluginKind::reflection).empty();
            properties[p.name] = is_timed           ? timed_schema(p)
                                 : may_have_texture ? textured_schema(p)
                                                    : parameter_schema(p);
            own.push_back(p.name);
        }
        for (const TableSchema& inner : table.tables) {
            properties[inner.name] = schema_of(inner);
            own.push_back(inner.name);
        }
        for (const PluginKey& key : table.plugins) {
            properties[key.key] = name_schema(parameter_in(table, key.key).meaning, key.kind);
            if (key.parameters_in.value_or("").empty()) continue;
            properties[*key.parameters_in] = inner_table(table, key);
            own.push_back(*key.parameters_in);
        }
        Json dependencies = Json::object();
        for (const PluginKey& key : table.plugins) {
            if (!key.parameters_in) continue;
            if (key.parameters_in->empty()) {
                const Json parameters = union_of(key.kind);
                // The table's own keys take precedence over plugin parameters of the same name.
                for (const auto& [name, schema] : parameters.items()) {
                    if (!properties.contains(name)) properties[name] = schema;
                }
            }
            put_unless_empty(dependencies, key.key, cases_of(key, own));
        }
        Json one{{"title", table.title},
                 {"description", table.meaning},
                 {"type", "object"},
                 {"properties", std::move(properties)}};
        put_unless_empty(one, "required", required_in(table.parameters));
        // A kernel file's parameters are unknown here: the cases for installed plugins close the table.
        const bool takes_kernels_parameters = std::ranges::any_of(table.plugins, [](const PluginKey& key) {
            return key.parameters_in == "" && has_kernels(key.kind);
        });
        if (!takes_kernels_parameters) one["additionalProperties"] = false;
        put_unless_empty(one, "dependencies", std::move(dependencies));
        if (!table.repeated) return one;
        return {{"title", table.title}, {"description", table.meaning}, {"type", "array"}, {"items", one}};
    }

    /// For each plugin that a key may name, the keys that the table then accepts.
    Json cases_of(const PluginKey& key, const std::vector<std::string>& own) {
        Json cases = Json::object();
        for (const Manifest* m : all(key.kind)) {
            define(*m, key.parameters_in->empty() ? own : std::vector<std::string>());
            Json is_it;
            is_it["properties"][key.key]["const"] = m->name;
            cases["allOf"].push_back({{"if", is_it}, {"then", takes(*m, *key.parameters_in)}});
        }
        return cases;
    }

    Json inner_table(const TableSchema& table, const PluginKey& key) const {
        Json properties = union_of(key.kind);
        add_common(key.kind, properties);
        Json inner{{"title", fmt::format("[{}.{}]", table.name, *key.parameters_in)},
                   {"description", fmt::format("parameters of the {} model", name_of(key.kind))},
                   {"type", "object"},
                   {"properties", std::move(properties)}};
        if (!has_kernels(key.kind)) inner["additionalProperties"] = false;
        return inner;
    }

    static const Parameter& parameter_in(const TableSchema& table, const std::string& name) {
        return *std::ranges::find(table.parameters, name, &Parameter::name);
    }

    /// The schema of an installed plugin's name, or a kernel file's.
    Json name_schema(const std::string& meaning, PluginKind kind) const {
        Json names{{"enum", Json::array()}};
        Json& summaries = names["x-taplo"]["docs"]["enumValues"] = Json::array();
        for (const Manifest* m : all(kind)) summaries.push_back(m->summary);
        for (const Manifest* m : all(kind)) names["enum"].push_back(m->name);
        Json schema{{"description", meaning}, {"type", "string"}};
        if (has_kernels(kind)) {
            schema["anyOf"] = {std::move(names), {{"pattern", "\\.kernel$"}}};
        } else {
            schema.update(names);
        }
        return schema;
    }

    /// The plugins of a kind that have a parameter of that name.
    std::vector<User> users_of(PluginKind kind, std::string_view name) const {
        std::vector<User> users;
        for (const Manifest* m : all(kind)) {
            for (const Parameter& p : m->parameters) {
                if (p.name == name) users.push_back({m, &p});
            }
        }
        return users;
    }

    /// The parameters of all plugins of a kind.
    Json union_of(PluginKind kind) const {
        Json properties = Json::object();
        for (const Manifest* m : all(kind)) {
            for (const Parameter& p : m->parameters) {
                if (!properties.contains(p.name)) properties[p.name] = merged(users_of(kind, p.name));
            }
        }
        return properties;
    }

    /// Defines the keys that a table accepts with a plugin, and the constraints of this plugin alone, where
    /// the table does not have them for all plugins. `own`: the table's own keys.
    void define(const Manifest& m, const std::vector<std::string>& own) {
        std::string description = m.summary;
        for (const Relation& r : m.relations) description += "\n" + text_of(r);
        Json schema{{"title", fmt::format("{}: {}", m.id(), m.title)},
                    {"description", description},
                    {"type", "object"},
                    {"properties", Json::object()}};
        Json& properties = schema["properties"];
        for (const std::string& key : own) properties[key] = true;
        for (const Parameter& p : m.parameters) {
            const bool is_said = !properties.contains(p.name) && is_agreed(users_of(m.kind, p.name));
            properties[p.name] = is_said ? Json(true) : parameter_schema(m, p);
        }
        add_common(m.kind, properties);
        put_unless_empty(schema, "required", required_in(m.parameters));
        schema["additionalProperties"] = false;
        definitions_[definition_name(m)] = std::move(schema);
    }

    /// Requires a table to accept a plugin's parameters, itself or in a table within it.
    static Json takes(const Manifest& m, const std::string& where) {
        if (where.empty()) return reference_to(m);
        Json schema;
        schema["properties"][where] = reference_to(m);
        if (!required_in(m.parameters).empty()) schema["required"] = Json::array({where});
        return schema;
    }

    /// [reflection] decides which material parameters apply to objects without a model of their own.
    Json material_dependencies() const {
        Json dependencies = Json::object();
        for (const TableSchema& chooser : scene_schema()) {
            for (const PluginKey& choice : chooser.plugins) {
                if (chooser.repeated || choice.parameters_in) continue;
                for (const Manifest* m : all(choice.kind)) {
                    Json then = parameters_elsewhere(choice.kind, *m);
                    if (then.empty()) continue;
                    Json is_it;
                    is_it["properties"][chooser.name] = {{"properties", {{choice.key, {{"const", m->name}}}}},
                                                         {"required", {choice.key}}};
                    dependencies[chooser.name]["allOf"].push_back({{"if", is_it}, {"then", then}});
                }
            }
        }
        return dependencies;
    }

    static Json parameters_elsewhere(PluginKind kind, const Manifest& m) {
        Json schema = Json::object();
        for (const TableSchema& table : scene_schema()) {
            for (const PluginKey& own : table.plugins) {
                if (!table.repeated || own.kind != kind || own.parameters_in.value_or("").empty()) continue;
                schema["properties"][table.name]["items"] = {{"if", {{"required", {own.key}}}},
                                                             {"then", true},
                                                             {"else", takes(m, *own.parameters_in)}};
            }
        }
        return schema;
    }

    std::vector<Manifest> installed_;
    Json definitions_ = Json::object();
};

}  // namespace

std::string scene_json_schema(std::span<const Manifest> installed) {
    return json_text(SchemaWriter(installed).write(), 2) + "\n";
}

}  // namespace candela
