#include "console/diagnostics_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "console/terminal.h"
#include "import/import.h"
#include "json/json.h"

import candela.util;

using candela::Diagnostic;
using candela::Help;
using candela::Severity;
using candela::SourceLocation;

namespace {

/// Hides the place in a scene that an importer made: nobody can look it up.
SourceLocation visible(SourceLocation place) {
    return importing::is_model(place.file) ? SourceLocation{.file = std::move(place.file)} : place;
}

std::string location(const SourceLocation& place) {
    if (place.line == 0) return place.file;
    return fmt::format("{}:{}:{}", place.file, place.line, place.column);
}

/// The characters of a line as they are printed; some take several columns, such as \u{1b}.
std::vector<std::string> characters_of(std::string_view line) {
    std::vector<std::string> result;
    while (!line.empty()) {
        const std::string_view character = candela::first_character(line);
        result.push_back(candela::printable(character));
        line.remove_prefix(character.size());
    }
    return result;
}

/// The width of a mark below a printed character.
std::size_t width_of(const std::string& printed) { return candela::character_count(printed); }

/// A sentence that may quote user input: on one line, without terminal control sequences, and of readable
/// length.
std::string sentence(std::string_view text) {
    constexpr std::size_t k_longest = 1000;
    std::string result;
    std::size_t count = 0;
    for (const std::string& character : characters_of(text.substr(0, 4 * k_longest))) {
        count += width_of(character);
        if (count > k_longest) return result + "...";
        result += character;
    }
    return result;
}

/// A line, or the readable part of it, and marks below the position. Tabs stay tabs, so that the marks line
/// up whatever the tab width.
std::array<std::string, 2> excerpt(std::string_view line, const SourceLocation& place) {
    constexpr std::size_t k_widest = 160;
    constexpr std::size_t k_before = 60;
    const std::size_t all = candela::character_count(line);
    auto marked = std::min(static_cast<std::size_t>(std::max(place.column, 1)) - 1, all);
    const std::size_t left_out = all > k_widest && marked > k_before ? marked - k_before : 0;
    for (std::size_t i = 0; i < left_out; ++i) line.remove_prefix(candela::first_character(line).size());
    marked -= left_out;
    const std::vector<std::string> characters = characters_of(line.substr(0, 4 * k_widest));
    const std::size_t last = std::min(k_widest, characters.size());
    const bool goes_on = all - left_out > last;
    std::string shown = left_out > 0 ? "..." : "";
    std::string marks = left_out > 0 ? "   " : "";
    const std::size_t marked_end = marked + static_cast<std::size_t>(std::max(place.length, 1));
    std::size_t underlined = 0;
    for (std::size_t i = 0; i < last; ++i) {
        shown += characters[i];
        const std::size_t width = width_of(characters[i]);
        if (i >= marked) {
            underlined += i < marked_end ? width : 0;
        } else if (characters[i] == "\t") {
            marks += '\t';
        } else {
            marks.append(width, ' ');
        }
    }
    if (goes_on) shown += "...";
    marks.append(std::max<std::size_t>(underlined, 1), '^');
    return {shown, marks};
}

std::string_view word(Severity severity) { return severity == Severity::error ? "error" : "warning"; }

/// The text to append to a message.
std::string remedy(const Help& help) {
    switch (help.topic) {
        case Help::Topic::all_plugins:
            return "; candela list shows all";
        case Help::Topic::plugin_trust:
            return ", or use --allow-untrusted-plugins";
        case Help::Topic::plugin_conformance:
            return "; candela plugin test shows details";
        default:
            return {};
    }
}

/// The hint to show next to a message.
std::string pointer(const Help& help) {
    switch (help.topic) {
        case Help::Topic::plugin:
            return fmt::format("(candela describe {})", help.subject);
        case Help::Topic::plugins_of_kind:
            return fmt::format("(candela list {})", help.subject);
        case Help::Topic::default_models:
            return fmt::format("--defaults uses {}; --shading and --reflection name others", help.subject);
        default:
            return {};
    }
}

}  // namespace

const HelpWords k_help_of_command{.after_message = remedy, .hint = pointer};

std::string full_message(std::string message, const Help& help, const HelpWords& words) {
    return std::move(message) + words.after_message(help);
}

std::string full_hint(const Diagnostic& diagnostic, const HelpWords& words) {
    const std::string more = words.hint(diagnostic.help);
    return diagnostic.hint + (diagnostic.hint.empty() || more.empty() ? "" : "  ") + more;
}

std::string diagnostics_text(const candela::Diagnostics& diagnostics, bool in_color, std::size_t most,
                             Shown shown, const HelpWords& words) {
    std::string result;
    std::vector<Diagnostic> all = diagnostics.sorted();
    if (shown == Shown::errors)
        std::erase_if(all, [](const Diagnostic& d) { return d.severity == Severity::warning; });
    for (std::size_t i = 0; i < std::min(most, all.size()); ++i) {
        Diagnostic& d = all[i];
        d.place = visible(std::move(d.place));
        const std::string_view style = d.severity == Severity::error ? k_bold_red : k_bold_magenta;
        result += fmt::format("{}{} {} {}\n", styled(k_bold, sentence(location(d.place)), in_color),
                              d.place.file.empty() ? "" : ":",
                              styled(style, fmt::format("{}:", word(d.severity)), in_color),
                              styled(k_bold, sentence(full_message(d.message, d.help, words)), in_color));
        const std::string hint = sentence(full_hint(d, words));
        if (const auto line = diagnostics.source_line(d.place)) {
            const auto [text, marks] = excerpt(*line, d.place);
            result += fmt::format("{:5} | {}\n{:5} | {}", d.place.line, text, "",
                                  styled(k_bold_green, marks, in_color));
            result += hint.empty() ? "\n" : fmt::format(" {}\n", hint);
        } else if (!hint.empty()) {
            result += fmt::format("      {}\n", hint);
        }
    }
    if (all.size() > most) {
        const auto rest = std::ranges::count(all.begin() + static_cast<std::ptrdiff_t>(most), all.end(),
                                             Severity::error, &Diagnostic::severity);
        result += fmt::format("and {} more ({} of them errors)\n", all.size() - most, rest);
    }
    return result;
}

std::string diagnostics_json(const candela::Diagnostics& diagnostics) {
    Json all = Json::array();
    for (const Diagnostic& d : diagnostics.sorted()) {
        const SourceLocation place = visible(d.place);
        all.push_back({{"severity", word(d.severity)},
                       {"file", place.file},
                       {"line", place.line},
                       {"column", place.column},
                       {"length", place.length},
                       {"message", full_message(d.message, d.help)},
                       {"hint", full_hint(d)}});
    }
    return json_text(all, 2);
}
