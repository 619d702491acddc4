// Diagnostics as text for people and as JSON for programs.
module;

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

module candela.diagnostics;

namespace candela {

namespace {

struct Paint {
    bool on;
    std::string operator()(std::string_view code, std::string_view text) const {
        return on ? fmt::format("\x1b[{}m{}\x1b[0m", code, text) : std::string(text);
    }
};

std::string location(const SourcePlace& place) {
    if (place.line == 0) return place.file;
    return fmt::format("{}:{}:{}", place.file, place.line, place.column);
}

/// Characters of a line, with what a terminal would obey, or cannot show, made visible as a question mark.
/// Tabs stay.
std::vector<std::string> characters_of(std::string_view line) {
    std::vector<std::string> result;
    for (const char c : line) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte >= 0x80 && byte < 0xc0 && !result.empty()) {
            result.back() += c;
        } else {
            const bool is_control = (byte < 0x20 && c != '\t') || byte == 0x7f;
            result.emplace_back(1, is_control ? '?' : c);
        }
    }
    return result;
}

/// A line, or as much of it as a person can look at, and marks below the place. Tabs stay tabs, so that the
/// marks stand under their text whatever a tab's width.
std::array<std::string, 2> excerpt(std::string_view line, const SourcePlace& place) {
    constexpr std::size_t k_widest = 160;
    constexpr std::size_t k_before = 60;
    const std::vector<std::string> characters = characters_of(line);
    const auto marked = std::min(static_cast<std::size_t>(std::max(place.column, 1)) - 1, characters.size());
    std::size_t first = 0;
    std::size_t last = characters.size();
    if (last > k_widest) {
        first = marked > k_before ? marked - k_before : 0;
        last = std::min(first + k_widest, last);
    }
    std::string shown = first > 0 ? "..." : "";
    std::string marks = first > 0 ? "   " : "";
    for (std::size_t i = first; i < last; ++i) {
        shown += characters[i];
        if (i < marked) marks += characters[i] == "\t" ? '\t' : ' ';
    }
    if (last < characters.size()) shown += "...";
    const std::size_t room = last > marked ? last - marked : 1;
    marks.append(std::clamp<std::size_t>(static_cast<std::size_t>(std::max(place.length, 1)), 1, room), '^');
    return {shown, marks};
}

std::string_view word(Severity severity) { return severity == Severity::error ? "error" : "warning"; }

}  // namespace

std::string Diagnostics::text(bool in_color, std::size_t most) const {
    const Paint paint{in_color};
    std::string result;
    const std::vector<Diagnostic> found = sorted();
    for (std::size_t i = 0; i < std::min(most, found.size()); ++i) {
        const Diagnostic& d = found[i];
        result += fmt::format(
            "{}{} {} {}\n", paint("1", location(d.place)), d.place.file.empty() ? "" : ":",
            paint(d.severity == Severity::error ? "1;31" : "1;35", fmt::format("{}:", word(d.severity))),
            paint("1", d.message));
        if (const auto line = source_line(d.place)) {
            const auto [shown, marks] = excerpt(*line, d.place);
            result += fmt::format("{:5} | {}\n{:5} | {}", d.place.line, shown, "", paint("1;32", marks));
            result += d.hint.empty() ? "\n" : fmt::format(" {}\n", d.hint);
        } else if (!d.hint.empty()) {
            result += fmt::format("      {}\n", d.hint);
        }
    }
    if (found.size() > most) {
        const auto rest = std::ranges::count(found.begin() + static_cast<std::ptrdiff_t>(most), found.end(),
                                             Severity::error, &Diagnostic::severity);
        result += fmt::format("and {} more ({} of them errors)\n", found.size() - most, rest);
    }
    return result;
}

std::string Diagnostics::json() const {
    using Json = nlohmann::ordered_json;
    Json all = Json::array();
    for (const Diagnostic& d : sorted()) {
        all.push_back({{"severity", word(d.severity)},
                       {"file", d.place.file},
                       {"line", d.place.line},
                       {"column", d.place.column},
                       {"length", d.place.length},
                       {"message", d.message},
                       {"hint", d.hint}});
    }
    return all.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace candela
