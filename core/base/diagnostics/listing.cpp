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

/// The number of bytes of a UTF-8 character with this first byte; 0 if there is none.
std::size_t size_by(unsigned char first) {
    if (first < 0x80) return 1;
    if (first < 0xc2) return 0;
    return first < 0xe0 ? 2 : (first < 0xf0 ? 3 : (first < 0xf5 ? 4 : 0));
}

/// The characters of a line. Control characters and what a terminal cannot show become question marks; tabs
/// stay.
std::vector<std::string> characters_of(std::string_view line) {
    std::vector<std::string> result;
    for (std::size_t i = 0; i < line.size();) {
        const auto first = static_cast<unsigned char>(line[i]);
        const std::size_t size = size_by(first);
        const std::string_view character = line.substr(i, std::max<std::size_t>(size, 1));
        const bool is_whole = size > 0 && character.size() == size &&
                              std::all_of(character.begin() + 1, character.end(), [](char c) {
                                  return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
                              });
        const bool is_c1 = first == 0xc2 && is_whole && static_cast<unsigned char>(character[1]) < 0xa0;
        const bool is_control = (first < 0x20 && first != '\t') || first == 0x7f || is_c1;
        result.emplace_back(is_whole && !is_control ? character : "?");
        i += is_whole ? size : 1;
    }
    return result;
}

/// A sentence that may quote user input: on one line, without terminal control sequences, and no longer than
/// anybody reads.
std::string sentence(std::string_view text) {
    constexpr std::size_t k_longest = 1000;
    std::string result;
    std::size_t count = 0;
    for (const std::string& character : characters_of(text.substr(0, 4 * k_longest))) {
        if (++count > k_longest) return result + "...";
        result += character;
    }
    return result;
}

/// A line, or as much of it as is readable, and marks below the position. Tabs stay tabs, so that the marks
/// line up whatever the width of a tab.
std::array<std::string, 2> excerpt(std::string_view line, const SourcePlace& place) {
    constexpr std::size_t k_widest = 160;
    constexpr std::size_t k_before = 60;
    const auto is_first_byte = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; };
    const auto all = static_cast<std::size_t>(std::ranges::count_if(line, is_first_byte));
    auto marked = std::min(static_cast<std::size_t>(std::max(place.column, 1)) - 1, all);
    const std::size_t left_out = all > k_widest && marked > k_before ? marked - k_before : 0;
    for (std::size_t i = 0; i < left_out; ++i) {
        do {
            line.remove_prefix(1);
        } while (!line.empty() && !is_first_byte(line.front()));
    }
    marked -= left_out;
    const std::vector<std::string> characters = characters_of(line.substr(0, 4 * k_widest));
    const std::size_t last = std::min(k_widest, characters.size());
    const bool goes_on = all - left_out > last;
    std::string shown = left_out > 0 ? "..." : "";
    std::string marks = left_out > 0 ? "   " : "";
    for (std::size_t i = 0; i < last; ++i) {
        shown += characters[i];
        if (i < marked) marks += characters[i] == "\t" ? '\t' : ' ';
    }
    if (goes_on) shown += "...";
    const std::size_t room = last > marked ? last - marked : 1;
    marks.append(std::clamp<std::size_t>(static_cast<std::size_t>(std::max(place.length, 1)), 1, room), '^');
    return {shown, marks};
}

std::string_view word(Severity severity) { return severity == Severity::error ? "error" : "warning"; }

}  // namespace

std::string Diagnostics::text(bool in_color, std::size_t most) const {
    const Paint paint{in_color};
    std::string result;
    const std::vector<std::size_t> order = order_of_places();
    for (std::size_t i = 0; i < std::min(most, order.size()); ++i) {
        const Diagnostic& d = all_[order[i]];
        result += fmt::format(
            "{}{} {} {}\n", paint("1", sentence(location(d.place))), d.place.file.empty() ? "" : ":",
            paint(d.severity == Severity::error ? "1;31" : "1;35", fmt::format("{}:", word(d.severity))),
            paint("1", sentence(d.message)));
        if (const auto line = source_line(d.place)) {
            const auto [shown, marks] = excerpt(*line, d.place);
            result += fmt::format("{:5} | {}\n{:5} | {}", d.place.line, shown, "", paint("1;32", marks));
            result += d.hint.empty() ? "\n" : fmt::format(" {}\n", sentence(d.hint));
        } else if (!d.hint.empty()) {
            result += fmt::format("      {}\n", sentence(d.hint));
        }
    }
    if (order.size() > most) {
        const auto rest = std::count_if(order.begin() + static_cast<std::ptrdiff_t>(most), order.end(),
                                        [&](std::size_t i) { return all_[i].severity == Severity::error; });
        result += fmt::format("and {} more ({} of them errors)\n", order.size() - most, rest);
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
