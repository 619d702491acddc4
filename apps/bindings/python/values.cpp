#include "values.h"
#include "scene_edit/text_edits.h"

import candela.util;

namespace candela::python {

namespace {

/// Converts NumPy numbers and arrays to Python's.
py::object plain(py::handle value) {
    if (py::hasattr(value, "tolist")) return value.attr("tolist")();
    if (py::hasattr(value, "__fspath__")) return value.attr("__fspath__")();
    return py::reinterpret_borrow<py::object>(value);
}

std::string key_of(py::handle key) {
    if (!py::isinstance<py::str>(key))
        throw py::type_error(
            fmt::format("a key of a scene is a string, not {}", py::str(py::repr(key)).cast<std::string>()));
    return key.cast<std::string>();
}

bool is_table(const Node& node) { return std::holds_alternative<TableNode>(node.value); }

bool is_list_of_tables(const Node& node) {
    const auto* const array = std::get_if<ArrayNode>(&node.value);
    return array != nullptr && !array->empty() && std::ranges::all_of(*array, is_table);
}

void add_lines(const TableNode& table, std::string& text) {
    for (const TableNode::Entry& entry : table.entries)
        text += fmt::format("{} = {}\n", toml_key(entry.key), toml_text(entry.node));
}

}  // namespace

Node node_of(py::handle given, const std::string& file) {
    const py::object value = plain(given);
    const SourceLocation place{.file = file};
    if (py::isinstance<py::bool_>(value)) return {place, value.cast<bool>()};
    if (py::isinstance<py::int_>(value)) return {place, value.cast<std::int64_t>()};
    if (py::isinstance<py::float_>(value)) return {place, value.cast<double>()};
    if (py::isinstance<py::str>(value)) return {place, value.cast<std::string>()};
    if (py::isinstance<py::dict>(value)) {
        TableNode table;
        for (const auto& [key, item] : value.cast<py::dict>())
            table.entries.push_back({key_of(key), place, node_of(item, file)});
        return {place, std::move(table)};
    }
    if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
        ArrayNode array;
        for (const py::handle item : value) array.push_back(node_of(item, file));
        return {place, std::move(array)};
    }
    throw py::type_error(
        fmt::format("{} is not a value for a scene; expected numbers, strings, True and False, and lists and "
                    "dictionaries of them",
                    py::str(py::repr(value)).cast<std::string>()));
}

std::string document_text(const py::dict& scene) {
    const Node document = node_of(scene, "");
    std::string values, tables;
    for (const TableNode::Entry& entry : std::get<TableNode>(document.value).entries) {
        const std::string key = toml_key(entry.key);
        if (const auto* const table = std::get_if<TableNode>(&entry.node.value)) {
            tables += fmt::format("\n[{}]\n", key);
            add_lines(*table, tables);
        } else if (is_list_of_tables(entry.node)) {
            for (const Node& item : std::get<ArrayNode>(entry.node.value)) {
                tables += fmt::format("\n[[{}]]\n", key);
                add_lines(std::get<TableNode>(item.value), tables);
            }
        } else {
            values += fmt::format("{} = {}\n", key, toml_text(entry.node));
        }
    }
    return values + tables;
}

}  // namespace candela::python
