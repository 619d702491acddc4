module;

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

module candela.scene;

import :fields;
import :tables;
import :text;
import :vocabulary;
import candela.api;
import candela.plugins;
import candela.util;

namespace candela {

const TableSchema& schema_of(std::string_view table) {
    return *std::ranges::find_if(scene_schema(), [&](const TableSchema& s) { return s.name == table; });
}

std::vector<std::string> names_in(std::span<const Parameter> schema, std::vector<std::string> keys) {
    for (const Parameter& p : schema) keys.push_back(p.name);
    return keys;
}

const Parameter* parameter_named(std::span<const Parameter> schema, std::string_view name) {
    const auto found = std::ranges::find(schema, name, &Parameter::name);
    return found != schema.end() ? &*found : nullptr;
}

const std::string& text(const ParamSet& set, std::string_view name) {
    return std::get<std::string>(set.get(name));
}
bool has(const ParamSet& set, std::string_view name) { return set.get(set.index_of(name)).has_value(); }

SceneTables::SceneTables(const MergedDocument& document, Registry& registry, Diagnostics& diagnostics)
    : root_(document.root), whole_(document.place), registry_(registry), diagnostics_(diagnostics) {}

const TableNode* SceneTables::single(const std::string& name) {
    const auto [known, is_new] = singles_.try_emplace(name, nullptr);
    const TableNode::Entry* const entry = root_.find(name);
    if (!is_new || entry == nullptr) return known->second;
    known->second = entry->node.table();
    if (known->second == nullptr) {
        const std::string what =
            entry->node.array() != nullptr ? "a list: there may be only one" : description(entry->node);
        diagnostics_.error(entry->key_place, fmt::format("'{}' is {}; expected the table {}", name, what,
                                                         schema_of(name).title));
    }
    return known->second;
}

TableContext SceneTables::context_of(const std::string& name) const {
    const TableNode::Entry* const entry = root_.find(name);
    return {.where = schema_of(name).title,
            .help = {},
            .place = entry != nullptr ? entry->key_place : whole_,
            .hint = hints_for(name, registry_),
            .lists_keys = true};
}

TableValues SceneTables::read_plain(const std::string& name, const SharedSchema& schema) {
    static const TableNode k_empty;
    const TableNode* const table = single(name);
    // A value that is not a table has been reported; don't report its missing keys as well.
    if (table == nullptr && root_.find(name) != nullptr)
        return {.set = ParamSet(schema), .validity = std::vector<bool>(schema->size())};
    const TableContext context = context_of(name);
    if (table != nullptr) report_unknown_keys(*table, names_in(*schema), context, diagnostics_);
    return read_parameters(table != nullptr ? *table : k_empty, schema, context, diagnostics_);
}

const PluginFile* SceneTables::known(PluginKind kind, const std::string& name, const SourceLocation& place) {
    if (const PluginFile* const plugin = registry_.find(kind, name)) return plugin;
    const bool is_kernel = is_kernel_file(name);
    if (is_kernel && !reported_kernels_.insert(name).second) return nullptr;
    const std::string shown = shown_model_name(name);
    if (is_kernel && !existing_file(shown, shown, place, diagnostics_)) return nullptr;
    try {
        registry_.require(kind, name);
    } catch (const KernelError& problem) {
        problem.report_in(diagnostics_);
    } catch (const Error& problem) {
        if (is_kernel && problem.category() == ErrorCategory::failure)
            diagnostics_.failure(place, problem.what(), "", problem.help());
        else
            diagnostics_.error(place, problem.what(), "", problem.help());
    }
    return nullptr;
}

}  // namespace candela
