module;

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

module candela.scene;

import :fields;
import :models;
import :tables;
import :vocabulary;
import candela.plugins;
import candela.util;

namespace candela {

ModelChooser::ModelChooser(const SceneRequest& request, SceneTables& tables)
    : request_(request), tables_(tables) {
    shading_ = named("shading", request.shading);
    reflection_ = named("reflection", request.reflection);
    use_defaults_if_agreed();
    read_shading_table();
    if (const TableNode* const table = tables.single("reflection")) {
        report_unknown_keys(
            *table, names_in(schema_of("reflection").parameters),
            {"[reflection]", {}, tables.whole(), "an object's material belongs in [object.material]"},
            tables.diagnostics());
    }
    if (reflection_) tables.known(PluginKind::reflection, reflection_->name, reflection_->place);
}

/// The model named by a setting, or by the `model` of a table.
std::optional<ModelChooser::Named> ModelChooser::named(const std::string& table_name,
                                                       const std::optional<ModelSetting>& setting) {
    if (setting) return Named{setting->name, {setting->origin, 0, 0, 0}};
    const TableNode* const table = tables_.single(table_name);
    if (table == nullptr) return std::nullopt;
    const Table<Model>& fields = table_name == "shading" ? own_tables().shading : own_tables().reflection;
    const ParamSet values =
        read_parameters(*table, fields.schema(), tables_.context_of(table_name), tables_.diagnostics()).set;
    if (!has(values, "model")) return std::nullopt;
    return Named{text(values, "model"), table->find("model")->node.place};
}

/// The model named by the object itself, unless a setting overrides it. Whether the value is a string is
/// checked with the object.
std::optional<ModelChooser::Named> ModelChooser::named_by(const TableNode& object, const std::string& key,
                                                          const std::optional<ModelSetting>& setting) const {
    const TableNode::Entry* const entry = object.find(key);
    if (entry == nullptr || setting) return std::nullopt;
    const auto* const name = std::get_if<std::string>(&entry->node.value);
    return name != nullptr ? std::optional(Named{*name, entry->node.place}) : std::nullopt;
}

/// Whether a table that names a model is missing although some object needs it.
bool ModelChooser::is_missing(const std::string& table) const {
    const TableNode::Entry* const objects = tables_.root().find("object");
    if (tables_.root().find(table) != nullptr || objects == nullptr || objects->node.array() == nullptr)
        return false;
    return std::ranges::any_of(*objects->node.array(), [&](const Node& object) {
        return object.table() != nullptr && object.table()->find(table) == nullptr;
    });
}

void ModelChooser::use_defaults_if_agreed() {
    const bool no_shading = !shading_ && is_missing("shading");
    const bool no_reflection = !reflection_ && is_missing("reflection");
    if (!no_shading && !no_reflection) return;
    const std::string missing = no_shading && no_reflection ? "shading or reflection model"
                                : no_shading                ? "shading model"
                                                            : "reflection model";
    std::vector<std::string> defaults;
    if (no_shading) defaults.push_back(fmt::format("{} shading", k_default_shading));
    if (no_reflection) defaults.push_back(fmt::format("{} reflection", k_default_reflection));
    const std::string both = fmt::format("{}", fmt::join(defaults, " and "));
    // Do not ask about a scene that is already wrong.
    const bool agreed =
        request_.use_defaults ||
        (request_.ask && (tables_.diagnostics().has_errors() ||
                          request_.ask(fmt::format("The scene names no {}. Use {}?", missing, both))));
    if (!agreed) {
        tables_.diagnostics().error(tables_.whole(), fmt::format("the scene names no {}", missing), "",
                                    {Help::Topic::default_models, both});
        return;
    }
    if (no_shading) shading_ = Named{k_default_shading, tables_.whole()};
    if (no_reflection) reflection_ = Named{k_default_reflection, tables_.whole()};
}

/// [shading] also contains the parameters of its model.
void ModelChooser::read_shading_table() {
    if (!shading_) return;
    const PluginFile* const plugin = tables_.known(PluginKind::shading, shading_->name, shading_->place);
    const TableNode* const table = tables_.single("shading");
    if (plugin == nullptr || table == nullptr || request_.shading) return;
    TableContext context = tables_.context_of("shading");
    context.help = {Help::Topic::plugin, plugin_id(PluginKind::shading, shading_->name)};
    context.lists_keys = false;
    report_unknown_keys(*table, names_in(plugin->manifest.parameters, {"model"}), context,
                        tables_.diagnostics());
    shading_parameters_ =
        read_parameters(*table, plugin->schema, context, tables_.diagnostics(), plugin->manifest.relations)
            .set;
}

Model ModelChooser::shading_for(const TableNode& object) {
    if (const auto own = named_by(object, "shading", request_.shading)) {
        const PluginFile* const plugin = tables_.known(PluginKind::shading, own->name, own->place);
        return plugin != nullptr ? Model{own->name, ParamSet(plugin->schema)} : Model{};
    }
    // A missing model has been reported with [shading].
    const PluginFile* const plugin =
        shading_ ? tables_.registry().find(PluginKind::shading, shading_->name) : nullptr;
    if (plugin == nullptr) return {};
    return {shading_->name, shading_parameters_ ? *shading_parameters_ : ParamSet(plugin->schema)};
}

void ModelChooser::set_reflection(Object& to, const TableNode& object, const std::string& label) {
    const TableNode::Entry* const entry = object.find("material");
    if (entry != nullptr && entry->node.table() == nullptr) {
        tables_.diagnostics().error(
            entry->node.place,
            fmt::format("'material' is {}; expected the table [object.material]", description(entry->node)));
        return;
    }
    const auto own = named_by(object, "reflection", request_.reflection);
    const auto& model = own ? own : reflection_;
    if (!model) return;
    // A missing model has been reported with [reflection], if that names it.
    const PluginFile* const plugin = own ? tables_.known(PluginKind::reflection, own->name, own->place)
                                         : tables_.registry().find(PluginKind::reflection, model->name);
    if (plugin == nullptr) return;
    TableNode material = entry != nullptr ? *entry->node.table() : TableNode();
    const TableContext context{fmt::format("[object.material] of {}", label),
                               {Help::Topic::plugin, plugin_id(PluginKind::reflection, model->name)},
                               entry != nullptr ? entry->key_place : to.place,
                               "",
                               hints_for("material", tables_.registry())};
    report_unknown_material_keys(material, *plugin, context,
                                 request_.reflection ? model_in_scene(object) : std::nullopt);
    to.common = take_common(material, *plugin, context);
    to.textures = take_textures(material, *plugin, context.where);
    // A texture that is white somewhere is no reason to warn.
    std::vector<Relation> relations = plugin->manifest.relations;
    std::erase_if(relations, [&](const Relation& r) {
        return r.only_warns && std::ranges::any_of(to.textures, [&](const ParameterTexture& t) {
                   return t.parameter == r.left || t.parameter == r.right;
               });
    });
    to.reflection = {
        model->name,
        read_parameters(material, plugin->schema, context, tables_.diagnostics(), relations).set};
}

/// The reflection model of an object according to the scene, whatever a setting says.
std::optional<ModelChooser::Named> ModelChooser::model_in_scene(const TableNode& object) {
    const auto own = named_by(object, "reflection", std::nullopt);
    const TableNode* const table = tables_.single("reflection");
    return own || table == nullptr ? own : named_by(*table, "model", std::nullopt);
}

/// Whether a key of a material belongs to the model that `replaced` names. If that is a kernel file that
/// cannot be used, nobody knows: a warning says so once, and all keys count as its own.
bool ModelChooser::belongs_to(const Named& replaced, const std::string& key) {
    const PluginFile* const plugin = tables_.registry().find(PluginKind::reflection, replaced.name);
    if (plugin != nullptr) return parameter_named(plugin->manifest.parameters, key) != nullptr;
    if (!is_kernel_file(replaced.name)) return false;
    if (unusable_kernels_.insert(replaced.name).second)
        tables_.diagnostics().warning(
            replaced.place, fmt::format("'{}' cannot be used, so it is unknown which material keys it reads; "
                                        "unknown ones are ignored",
                                        shown_model_name(replaced.name)));
    return true;
}

/// If a reflection model is set for all objects, a material written for another model is not an error: keys
/// of the model that is `replaced`, or of an installed one, are ignored.
void ModelChooser::report_unknown_material_keys(const TableNode& material, const PluginFile& plugin,
                                                const TableContext& context,
                                                const std::optional<Named>& replaced) {
    const std::vector<std::string> known_keys =
        names_in(plugin.manifest.parameters, names_in(material_schema().parameters));
    TableNode unknown;
    for (const TableNode::Entry& entry : material.entries) {
        if (std::ranges::find(known_keys, entry.key) != known_keys.end()) continue;
        const std::vector<std::string> others = models_with(entry.key);
        if (others.empty()) {
            if (!replaced || !belongs_to(*replaced, entry.key)) unknown.entries.push_back(entry);
        } else if (!request_.reflection) {
            tables_.diagnostics().error(
                entry.key_place,
                fmt::format("{} has no parameter '{}', which {} {}", context.help.subject, entry.key,
                            fmt::join(others, ", "), others.size() == 1 ? "has" : "have"),
                context.hint ? context.hint(entry.key) : "", context.help);
        }
    }
    report_unknown_keys(unknown, known_keys, context, tables_.diagnostics());
}

std::vector<std::string> ModelChooser::models_with(const std::string& key) {
    std::vector<std::string> models;
    for (const PluginFile* plugin : tables_.registry().list()) {
        if (plugin->manifest.kind == PluginKind::reflection &&
            std::ranges::any_of(plugin->manifest.parameters,
                                [&](const Parameter& p) { return p.name == key; })) {
            models.push_back(plugin->manifest.id());
        }
    }
    return models;
}

}  // namespace candela
