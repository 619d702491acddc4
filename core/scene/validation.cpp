module;

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

module candela.scene;

import :notations;
import :text;
import candela.api;
import candela.plugins;
import candela.util;

namespace candela {

namespace {

namespace fs = std::filesystem;

/// A number; only an integer if `whole_only`.
std::optional<double> number(const Node& node, bool whole_only) {
    if (const auto* i = std::get_if<std::int64_t>(&node.value)) return static_cast<double>(*i);
    if (const auto* d = std::get_if<double>(&node.value); d != nullptr && !whole_only) return *d;
    return std::nullopt;
}

/// A value too large for a float becomes infinity, which the range check then reports.
std::optional<Vec3> three_numbers(const Node& node, bool whole_only) {
    const ArrayNode* const array = node.array();
    if (array == nullptr || array->size() != 3) return std::nullopt;
    std::array<float, 3> v{};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto x = number((*array)[i], whole_only);
        if (!x) return std::nullopt;
        v[i] = static_cast<float>(*x);
    }
    return Vec3{v[0], v[1], v[2]};
}

std::optional<Value> matrix(const Node& node) {
    const ArrayNode* const rows = node.array();
    if (rows == nullptr || rows->size() != 3) return std::nullopt;
    Matrix result{};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto row = three_numbers((*rows)[i], false);
        if (!row) return std::nullopt;
        result[3 * i] = row->x;
        result[3 * i + 1] = row->y;
        result[3 * i + 2] = row->z;
    }
    return result;
}

/// At least one number.
std::optional<Value> numbers(const Node& node) {
    const ArrayNode* const array = node.array();
    if (array == nullptr || array->empty()) return std::nullopt;
    NumberList result;
    for (const Node& each : *array) {
        const auto x = number(each, false);
        if (!x) return std::nullopt;
        result.push_back(static_cast<float>(*x));
    }
    return result;
}

std::optional<Value> as_value(const Node& node, const Parameter& p) {
    switch (p.type) {
        case ParamType::real:
            if (const auto x = number(node, false)) return *x;
            return std::nullopt;
        case ParamType::integer:
            if (const auto* i = std::get_if<std::int64_t>(&node.value)) return *i;
            return std::nullopt;
        case ParamType::boolean:
            if (const auto* b = std::get_if<bool>(&node.value)) return *b;
            return std::nullopt;
        case ParamType::choice:
        case ParamType::text:
        case ParamType::file:
            if (const auto* s = std::get_if<std::string>(&node.value)) return *s;
            return std::nullopt;
        case ParamType::matrix:
            return matrix(node);
        case ParamType::numbers:
            return numbers(node);
        case ParamType::rgb:
            if (const auto x = number(node, false)) {
                const auto f = static_cast<float>(*x);
                return Vec3{f, f, f};
            }
            [[fallthrough]];
        default:
            if (const auto v = three_numbers(node, p.type == ParamType::color)) return *v;
            return std::nullopt;
    }
}

/// A number as its author wrote it; empty for anything else.
std::string number_as_written(const Node& node, const Diagnostics& diagnostics) {
    constexpr std::size_t k_longest = 40;
    const bool is_number =
        std::holds_alternative<std::int64_t>(node.value) || std::holds_alternative<double>(node.value);
    const std::string text = is_number ? as_written(node, diagnostics) : "";
    return text.size() <= k_longest ? text : "";
}

/// Like description(), but with a number as its author wrote it: 255.0, not 255.
std::string described(const Node& node, const Diagnostics& diagnostics) {
    const std::string written = number_as_written(node, diagnostics);
    if (written.empty()) return description(node);
    return fmt::format("the {} {}", std::holds_alternative<double>(node.value) ? "number" : "integer",
                       written);
}

/// The problem with a list where numbers were expected: "its second value is a string, …".
std::string found(const Node& node, const Parameter& p, const Diagnostics& diagnostics) {
    const ArrayNode* const array = node.array();
    if (array != nullptr && p.type == ParamType::numbers) {
        const auto wrong =
            std::ranges::find_if(*array, [](const Node& each) { return !number(each, false); });
        if (wrong == array->end()) return "an empty list";
        return fmt::format("a list whose value {} is {}", wrong - array->begin() + 1,
                           described(*wrong, diagnostics));
    }
    const bool takes_three = p.type >= ParamType::vector && p.type <= ParamType::rgb;
    if (array == nullptr || array->size() != 3 || !takes_three) return described(node, diagnostics);
    constexpr std::array<std::string_view, 3> k_ordinals = {"first", "second", "third"};
    for (std::size_t i = 0; i < 3; ++i) {
        if (!number((*array)[i], p.type == ParamType::color)) {
            return fmt::format("a list whose {} value is {}", k_ordinals[i],
                               described((*array)[i], diagnostics));
        }
    }
    return description(node);
}

std::string joined(const std::string& a, const std::string& b) {
    return a.empty() || b.empty() ? a + b : a + "  " + b;
}

std::string color_text(Vec3 color) { return toml_text(color, ParamType::color); }

/// The colour that a string names, as on the web.
std::optional<Vec3> color_called(std::string_view text) {
    if (text.starts_with('#') && (text.size() == 7 || text.size() == 4)) {
        const std::size_t digits = (text.size() - 1) / 3;
        std::array<float, 3> channels{};
        for (std::size_t i = 0; i < 3; ++i) {
            unsigned value = 0;
            const char* const begin = text.data() + 1 + i * digits;
            const auto [end, problem] = std::from_chars(begin, begin + digits, value, 16);
            if (problem != std::errc() || end != begin + digits) return std::nullopt;
            channels[i] = static_cast<float>(digits == 1 ? 17 * value : value);
        }
        return Vec3{channels[0], channels[1], channels[2]};
    }
    // The most common ones of CSS Color Module Level 4.
    struct Name {
        std::string_view name;
        Vec3 color;
    };
    static constexpr auto k_names = std::to_array<Name>({
        {"black", {0, 0, 0}},
        {"blue", {0, 0, 255}},
        {"brown", {165, 42, 42}},
        {"cyan", {0, 255, 255}},
        {"gold", {255, 215, 0}},
        {"gray", {128, 128, 128}},
        {"green", {0, 128, 0}},
        {"grey", {128, 128, 128}},
        {"magenta", {255, 0, 255}},
        {"orange", {255, 165, 0}},
        {"pink", {255, 192, 203}},
        {"purple", {128, 0, 128}},
        {"red", {255, 0, 0}},
        {"white", {255, 255, 255}},
        {"yellow", {255, 255, 0}},
    });
    const auto found = std::ranges::find_if(k_names, [&](const Name& each) {
        return std::ranges::equal(each.name, text, [](char a, char b) { return a == b || a == (b | 0x20); });
    });
    return found != k_names.end() ? std::optional(found->color) : std::nullopt;
}

/// The correct form of a colour in another notation; empty if unknown.
std::string color_hint(const Node& node) {
    constexpr std::string_view k_channels = "three integers 0 to 255";
    if (const auto* const text = std::get_if<std::string>(&node.value)) {
        const auto color = color_called(*text);
        return fmt::format("write {}", color ? color_text(*color) : std::string(k_channels));
    }
    std::array<double, 3> values{};
    if (const auto grey = number(node, false)) {
        values.fill(*grey);
    } else {
        const ArrayNode* const array = node.array();
        // Four include alpha.
        if (array == nullptr || array->size() < 3 || array->size() > 4) return "";
        for (std::size_t i = 0; i < 3; ++i) {
            const auto value = number((*array)[i], false);
            if (!value) return "";
            values[i] = *value;
        }
    }
    if (!std::ranges::all_of(values, [](double v) { return v >= 0 && v <= 255; })) return "";
    const bool are_fractions = std::ranges::all_of(values, [](double v) { return v <= 1; });
    const auto channel = [&](double v) { return static_cast<float>(are_fractions ? 255 * v : v); };
    return fmt::format("did you mean {}?",
                       color_text({channel(values[0]), channel(values[1]), channel(values[2])}));
}

/// Whether the value is written in the file, rather than interpolated by an animation.
bool is_written_as_list(const Node& node, const Diagnostics& diagnostics) {
    if (node.place.line == 0) return true;
    const std::string text = as_written(node, diagnostics);
    const std::size_t second = text.find_first_not_of(" \t", 1);
    return text.starts_with('[') && second != std::string::npos && text[second] >= '0' && text[second] <= '9';
}

/// `node` as a value of the parameter's type, without checking its range. Reports a type mismatch.
std::optional<Value> typed_value(const Node& node, const Parameter& parameter, Diagnostics& diagnostics) {
    if (is_notation(node, parameter)) return noted_number(node, parameter, diagnostics);
    auto value = as_value(node, parameter);
    if (!value) {
        diagnostics.error(node.place,
                          fmt::format("'{}' is {}; expected {}", parameter.name,
                                      found(node, parameter, diagnostics), constraint_text(parameter)),
                          parameter.type == ParamType::color ? color_hint(node) : "");
    }
    return value;
}

/// Reports violated relations between valid values.
void check_relations(const TableNode& table, TableValues& values, std::span<const Relation> relations,
                     const TableContext& context, Diagnostics& diagnostics) {
    for (const Relation& relation : relations) {
        // A rejected value leaves its default, which need not be consistent with the others.
        if (!values.are_valid({relation.left, relation.right})) continue;
        const auto wrong = validation_error(relation, values.set);
        if (!wrong) continue;
        const TableNode::Entry* entry = table.find(relation.left);
        if (entry == nullptr) entry = table.find(relation.right);
        const SourceLocation place = entry != nullptr ? entry->node.place : context.place;
        if (relation.only_warns) {
            diagnostics.warning(place, fmt::format("{}: {}", context.where, *wrong));
        } else {
            diagnostics.error(place, fmt::format("{}: {}", context.where, *wrong));
            values.breaks_relation = true;
        }
    }
}

}  // namespace

std::optional<Value> valid_value(const Node& node, const Parameter& p, Diagnostics& diagnostics) {
    auto value = typed_value(node, p, diagnostics);
    if (!value) return std::nullopt;
    if (validation_error(p, *value)) {
        const auto wrong = validation_error(p, *value, number_as_written(node, diagnostics));
        std::string hint;
        if (p.type == ParamType::choice) hint = suggestion(std::get<std::string>(*value), p.choices);
        diagnostics.error(node.place, fmt::format("'{}': {}", p.name, *wrong), hint);
        return std::nullopt;
    }
    if (p.type == ParamType::color) {
        auto& color = std::get<Vec3>(*value);
        if (color.x > 255 || color.y > 255 || color.z > 255) {
            diagnostics.warning(node.place,
                                fmt::format("'{}': 256 counts as 255, the largest 8-bit number", p.name));
            color = {std::min(color.x, 255.0f), std::min(color.y, 255.0f), std::min(color.z, 255.0f)};
        }
        if (std::max({color.x, color.y, color.z}) == 1 && is_written_as_list(node, diagnostics)) {
            diagnostics.warning(
                node.place,
                fmt::format("'{}': {} is almost black, as channels are 0 to 255", p.name, color_text(color)),
                fmt::format("did you mean {}?", color_text(255.0f * color)));
        }
    }
    if (p.type == ParamType::file) {
        const auto& written = std::get<std::string>(*value);
        if (written.empty()) {
            diagnostics.error(node.place, fmt::format("'{}' is empty; expected a quoted path", p.name));
            return std::nullopt;
        }
        const auto file = existing_file(path_at(node.place, written), written, node.place, diagnostics);
        if (!file) return std::nullopt;
        value = *file;
    }
    return value;
}

bool TableValues::is_valid(std::string_view name) const {
    const std::size_t index = set.index_of(name);
    return index == validity.size() || validity[index];
}

bool TableValues::are_valid(std::initializer_list<std::string_view> names) const {
    return std::ranges::all_of(names, [&](std::string_view name) { return is_valid(name); });
}

bool TableValues::are_valid() const {
    return std::ranges::all_of(validity, [](bool is_valid) { return is_valid; });
}

TableValues read_parameters(const TableNode& table, SharedSchema schema, const TableContext& context,
                            Diagnostics& diagnostics, std::span<const Relation> relations) {
    TableValues values{.set = ParamSet(std::move(schema))};
    for (std::size_t i = 0; i < values.set.schema().size(); ++i) {
        const Parameter& p = values.set.schema()[i];
        const TableNode::Entry* const entry = table.find(p.name);
        if (entry == nullptr) {
            values.validity.push_back(p.default_value.has_value());
            if (!p.default_value) {
                diagnostics.error(
                    context.place,
                    fmt::format("{} has no '{}': {}", context.where, p.name, constraint_text(p)), p.meaning,
                    context.help);
            }
            continue;
        }
        auto value = valid_value(entry->node, p, diagnostics);
        values.validity.push_back(value.has_value());
        if (value) values.set.set(i, *std::move(value));
    }
    check_relations(table, values, relations, context, diagnostics);
    return values;
}

TableValues read_parameters(const TableNode& table, const PluginFile& plugin, const TableContext& context,
                            Diagnostics& diagnostics) {
    std::vector<std::string> known;
    for (const Parameter& p : *plugin.schema) known.push_back(p.name);
    report_unknown_keys(table, known, context, diagnostics);
    return read_parameters(table, plugin.schema, context, diagnostics, plugin.manifest.relations);
}

void report_unknown_keys(const TableNode& table, std::span<const std::string> known,
                         const TableContext& context, Diagnostics& diagnostics) {
    std::string note = context.note.empty() ? "" : fmt::format("({})", context.note);
    if (context.lists_keys) note = joined(fmt::format("(known: {})", fmt::join(known, ", ")), note);
    for (const TableNode::Entry& entry : table.entries) {
        if (std::ranges::find(known, entry.key) != known.end()) continue;
        const std::string meant = context.hint ? context.hint(entry.key) : "";
        diagnostics.error(entry.key_place, fmt::format("unknown key '{}' in {}", entry.key, context.where),
                          joined(meant.empty() ? suggestion(entry.key, known) : meant, note), context.help);
    }
}

}  // namespace candela
