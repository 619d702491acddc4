// Colours of objects and parameters of their materials that have a picture instead of a value.
module;

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

module candela.scene;

import :fields;
import :models;
import :tables;
import :textures;
import :vocabulary;
import candela.api;
import candela.plugins;
import candela.util;

namespace candela {

namespace {

bool is_real(const Parameter& p) { return p.type == ParamType::real; }

/// The value where the texel is 1, which stands for the parameter until a point has its own: relations
/// between parameters hold for it.
Node factor_of(const ParameterTexture& texture, const Parameter& p, const SourceLocation& place) {
    const auto within = [&](float value) {
        const float margin = 1e-6f * std::max(1.0f, std::abs(value));
        if (value <= p.minimum) value = p.minimum + (p.minimum_excluded ? margin : 0);
        if (value >= p.maximum) value = p.maximum - (p.maximum_excluded ? margin : 0);
        return shortest(value);
    };
    const Vec3 sum = texture.scale + texture.offset;
    if (is_real(p)) return {place, within(sum.x)};
    ArrayNode channels;
    for (const float value : {sum.x, sum.y, sum.z}) channels.push_back({place, within(value)});
    return {place, std::move(channels)};
}

/// The tables of a textured parameter: one, or the list of a product's factors. Empty if it has a value.
std::vector<const Node*> tables_in(const Node& node) {
    if (node.table() != nullptr) return {&node};
    std::vector<const Node*> factors;
    const ArrayNode* const list = node.array();
    if (list == nullptr || std::ranges::none_of(*list, [](const Node& n) { return n.table() != nullptr; }))
        return factors;
    for (const Node& factor : *list) factors.push_back(&factor);
    return factors;
}

/// The product where all texels are 1.
Node factor_of(std::span<const ParameterTexture> factors, const Parameter& p, const SourceLocation& place) {
    if (factors.size() == 1) return factor_of(factors.front(), p, place);
    float product = 1;
    for (const ParameterTexture& factor : factors)
        product *= std::clamp(factor.scale.x + factor.offset.x, p.minimum, p.maximum);
    return {place, shortest(product)};
}

}  // namespace

std::vector<ParameterTexture> ModelChooser::take_textures(TableNode& material, const PluginFile& plugin,
                                                          const std::string& where) {
    const Manifest& manifest = plugin.manifest;
    return take_textures(material, manifest.parameters, where, [&](const Parameter& p) {
        if (takes_texture(manifest, p)) return std::string();
        if (!manifest.surface_needs.varying)
            return fmt::format("{} has the same parameters at every point", manifest.id());
        return fmt::format("its value is {}", constraint_text(p));
    });
}

CommonMaterial ModelChooser::take_common(TableNode& material, const PluginFile& plugin,
                                         const TableContext& context) {
    const Table<CommonMaterial>& keys = own_tables().material;
    TableNode own;
    std::erase_if(material.entries, [&](const TableNode::Entry& entry) {
        const bool is_own = parameter_named(*keys.schema(), entry.key) != nullptr &&
                            parameter_named(plugin.manifest.parameters, entry.key) == nullptr;
        if (is_own) own.entries.push_back(entry);
        return is_own;
    });
    CommonMaterial common;
    if (own.entries.empty()) return common;
    common.textures = take_textures(own, *keys.schema(), context.where, [](const Parameter& p) {
        return takes_texture(p) ? std::string() : fmt::format("its value is {}", constraint_text(p));
    });
    keys.assign(&own, read_parameters(own, keys.schema(), context, tables_.diagnostics()).set, common);
    return common;
}

std::optional<ParameterTexture> ModelChooser::take_color_texture(TableNode& object,
                                                                 const std::string& where) {
    const auto textures =
        take_textures(object, {color_parameter()}, where, [](const Parameter&) { return std::string(); });
    return textures.empty() ? std::nullopt : std::optional(textures.front());
}

/// Replaces each table among the material's values by a number, and returns what the tables say.
std::vector<ParameterTexture> ModelChooser::take_textures(
    TableNode& material, const std::vector<Parameter>& parameters, const std::string& where,
    const std::function<std::string(const Parameter&)>& why_not) {
    std::vector<ParameterTexture> textures;
    std::vector<std::string> broken;
    const bool is_of_every_material = &parameters == own_tables().material.schema().get();
    for (const Parameter& p : parameters) {
        TableNode::Entry* const entry = material.find(p.name);
        const std::vector<const Node*> tables =
            entry != nullptr ? tables_in(entry->node) : std::vector<const Node*>();
        if (tables.empty()) continue;
        const std::string subject = fmt::format("'{}' in {}", p.name, where);
        std::vector<ParameterTexture> factors;
        if (const std::string why = why_not(p); !why.empty())
            tables_.diagnostics().error(entry->node.place,
                                        fmt::format("{} cannot have a texture: {}", subject, why));
        else if (tables.size() > 1 && !(is_of_every_material && p.name == "opacity"))
            tables_.diagnostics().error(
                entry->node.place, fmt::format("{} cannot have {} textures: only 'opacity' may be a product",
                                               subject, tables.size()));
        else
            factors = factors_in(tables, p, subject);
        if (factors.size() == tables.size()) {
            if (p.type == ParamType::color)
                std::erase_if(material.entries, [&](const auto& e) { return e.key == p.name; });
            else
                entry->node = factor_of(factors, p, entry->node.place);
            std::ranges::move(factors, std::back_inserter(textures));
        } else {
            broken.push_back(p.name);
        }
    }
    std::erase_if(material.entries,
                  [&](const auto& e) { return std::ranges::find(broken, e.key) != broken.end(); });
    return textures;
}

/// Those that are valid; the others have been reported.
std::vector<ParameterTexture> ModelChooser::factors_in(std::span<const Node* const> tables,
                                                       const Parameter& parameter, const std::string& where) {
    std::vector<ParameterTexture> factors;
    for (const Node* const node : tables) {
        if (node->table() == nullptr) {
            tables_.diagnostics().error(
                node->place,
                fmt::format("a factor of {} is {}, not a texture or an attribute", where, description(*node)),
                R"(write { texture = "..." } or { attribute = "..." }, and a number as 'scale' of one)");
            continue;
        }
        if (auto texture = texture_in(*node->table(), parameter, where, node->place))
            factors.push_back(std::move(*texture));
    }
    return factors;
}

/// `where`: the parameter, for messages. Nothing if the table is invalid, which has been reported.
std::optional<ParameterTexture> ModelChooser::texture_in(const TableNode& table, const Parameter& parameter,
                                                         const std::string& where,
                                                         const SourceLocation& place) {
    Diagnostics& diagnostics = tables_.diagnostics();
    const std::size_t errors = diagnostics.error_count();
    const bool is_attribute = table.find("attribute") != nullptr;
    const Table<ParameterTexture>& keys = is_attribute ? own_tables().attribute : own_tables().texture;
    TableContext context{where, {}, place};
    context.lists_keys = true;
    report_unknown_keys(table,
                        is_attribute ? names_in(*keys.schema()) : names_in(*keys.schema(), {"transform"}),
                        context, diagnostics);
    ParameterTexture texture{.parameter = parameter.name};
    keys.assign(&table, read_parameters(table, keys.schema(), context, diagnostics).set, texture);
    const auto require_three = [&](const char* key, const Vec3& value) {
        if (is_real(parameter) && (value.x != value.y || value.x != value.z))
            diagnostics.error(table.find(key)->node.place,
                              fmt::format("'{}' of {} has three numbers; the parameter has one", key, where));
    };
    if (is_attribute && texture.attribute.empty())
        diagnostics.error(
            table.find("attribute")->node.place,
            fmt::format("'attribute' of {} is empty; expected its name in the mesh file", where));
    require_three("scale", texture.scale);
    require_three("offset", texture.offset);
    if (!is_attribute) read_transform(table, context, diagnostics, texture.placing.transform);
    if (diagnostics.error_count() != errors) return std::nullopt;
    return texture;
}

}  // namespace candela
