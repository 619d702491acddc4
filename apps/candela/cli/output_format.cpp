#include "cli/output_format.h"

#include <fmt/format.h>

#include <utility>

#include "console/reporting.h"

import candela.api;
import candela.plugins;
import candela.scene;
import candela.util;

namespace po = boost::program_options;
using candela::Error;
using candela::ErrorCategory;
using candela::PluginKind;

namespace {

constexpr const char* k_option = "format-set";

/// "quality=80" as an entry of a table.
candela::TableNode::Entry entry_from(const std::string& text, candela::Diagnostics& diagnostics) {
    const std::size_t equals = text.find('=');
    if (equals == 0 || equals == std::string::npos)
        throw Error(ErrorCategory::bad_request,
                    fmt::format("--{0} '{1}' has no value; expected NAME=VALUE, such as --{0} quality=80",
                                k_option, text));
    const std::string name = text.substr(0, equals);
    const candela::SourceLocation place{fmt::format("--{} {}", k_option, name), 0, 0, 0};
    auto value = candela::parse_value(text.substr(equals + 1), place, diagnostics);
    return {name, place, value ? *std::move(value) : candela::Node{place, {}}};
}

}  // namespace

void add_format_option(CommandLine& line) {
    line.options()(k_option, po::value<std::vector<std::string>>()->value_name("NAME=VALUE"),
                   "set a parameter of the picture's format, such as quality=80 of a .jpg (candela describe "
                   "image/jpeg); can be repeated");
}

candela::OutputFormat output_format_from(const CommandLine& line, const std::filesystem::path& picture,
                                         candela::Registry& registry) {
    candela::OutputFormat format = candela::format_of(picture, registry);
    if (!line.has(k_option)) return format;
    candela::Diagnostics diagnostics;
    candela::TableNode table;
    for (const std::string& text : line.all(k_option)) {
        candela::TableNode::Entry entry = entry_from(text, diagnostics);
        // The last one wins, as with --set.
        std::erase_if(table.entries, [&](const auto& before) { return before.key == entry.key; });
        table.entries.push_back(std::move(entry));
    }
    if (diagnostics.has_errors()) throw usage_error(diagnostics);
    const candela::PluginFile& plugin = registry.require(PluginKind::image, format.plugin);
    const std::string id = plugin.manifest.id();
    const candela::TableContext context{id, {candela::Help::Topic::plugin, id}, {}};
    format.parameters = read_parameters(table, plugin, context, diagnostics).set;
    if (diagnostics.has_errors()) throw usage_error(diagnostics);
    return format;
}

std::vector<std::string> format_words_from(const CommandLine& line) {
    std::vector<std::string> words;
    for (const std::string& value : line.all(k_option))
        words.push_back(fmt::format("--{}={}", k_option, value));
    return words;
}
