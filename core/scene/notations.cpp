module;

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <variant>

module candela.scene;

import :notations;
import :photometry;
import candela.plugins;
import candela.util;

namespace candela {

namespace {

std::string_view trimmed(std::string_view text) {
    while (text.starts_with(' ')) text.remove_prefix(1);
    while (text.ends_with(' ')) text.remove_suffix(1);
    return text;
}

/// A finite number that is all of the text.
std::optional<double> number_from(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double x = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), x);
    const bool is_number = problem == std::errc() && end == text.data() + text.size() && std::isfinite(x);
    return is_number ? std::optional(x) : std::nullopt;
}

std::optional<double> number_in(const Node& node) {
    if (const auto* whole = std::get_if<std::int64_t>(&node.value)) return static_cast<double>(*whole);
    if (const auto* real = std::get_if<double>(&node.value)) return *real;
    return std::nullopt;
}

/// An exposure value: "EV 12", "EV100 9.5", "12".
std::optional<double> exposure_value(std::string_view text) {
    text = trimmed(text);
    for (const std::string_view prefix : {"EV100", "EV"}) {
        if (!text.starts_with(prefix)) continue;
        text.remove_prefix(prefix.size());
        break;
    }
    return number_from(trimmed(text));
}

/// The exposure value of a camera's settings.
std::optional<double> camera_exposure(const Node& node, const std::string& name, Diagnostics& diagnostics) {
    struct Setting {
        std::string key;
        double value;
        const char* meaning;
    };
    std::array<Setting, 3> settings{{{"aperture", 0, "the f-number"},
                                     {"time", 0, "the shutter time in seconds"},
                                     {"iso", 100, "the sensor's speed"}}};
    const TableNode& table = *node.table();
    const std::array<std::string, 3> keys{settings[0].key, settings[1].key, settings[2].key};
    bool is_valid = true;
    for (const TableNode::Entry& entry : table.entries) {
        const auto setting =
            std::ranges::find_if(settings, [&](const Setting& s) { return s.key == entry.key; });
        if (setting == settings.end()) {
            diagnostics.error(entry.key_place, fmt::format("unknown key '{}' in '{}'", entry.key, name),
                              suggestion(entry.key, keys));
            is_valid = false;
            continue;
        }
        const auto value = number_in(entry.node);
        if (!value || !(*value > 0) || !std::isfinite(*value)) {
            diagnostics.error(entry.node.place,
                              fmt::format("'{}' is {}; expected {}, greater than 0", entry.key,
                                          description(entry.node), setting->meaning));
            is_valid = false;
            continue;
        }
        setting->value = *value;
    }
    for (const Setting& setting : settings) {
        if (setting.key == "iso" || table.find(setting.key) != nullptr) continue;
        diagnostics.error(node.place, fmt::format("'{}' has no '{}': {}", name, setting.key, setting.meaning),
                          "write { aperture = 8, time = 0.008, iso = 200 }");
        is_valid = false;
    }
    if (!is_valid) return std::nullopt;
    const auto& [aperture, time, iso] = settings;
    return 2 * std::log2(aperture.value) - std::log2(time.value) - std::log2(iso.value / 100);
}

/// The intensity of a light in the units of its kind.
std::optional<double> light_intensity(const Parameter& parameter, const Node& node,
                                      Diagnostics& diagnostics) {
    const auto quantity = photometric_from(std::get<std::string>(node.value));
    if (quantity && (quantity->unit == "lx") == (parameter.notation == Notation::illuminance))
        return intensity_of(*quantity);
    std::string hint;
    if (quantity)
        hint = parameter.notation == Notation::illuminance
                   ? "a light from far away has an illuminance, in lx; lm, cd and W are for lights with a "
                     "position"
                   : "a light with a position has an intensity in cd, or a flux in lm or W; lx is for lights "
                     "from "
                     "far away";
    diagnostics.error(
        node.place,
        fmt::format("'{}' is {}; expected {}", parameter.name, description(node), constraint_text(parameter)),
        hint);
    return std::nullopt;
}

}  // namespace

bool is_notation(const Node& node, const Parameter& parameter) {
    const bool is_text = std::holds_alternative<std::string>(node.value);
    return parameter.notation == Notation::exposure ? is_text || node.table() != nullptr
                                                    : parameter.notation != Notation::plain && is_text;
}

std::optional<double> noted_number(const Node& node, const Parameter& parameter, Diagnostics& diagnostics) {
    if (node.table() != nullptr) return camera_exposure(node, parameter.name, diagnostics);
    if (parameter.notation != Notation::exposure) return light_intensity(parameter, node, diagnostics);
    const auto value = exposure_value(std::get<std::string>(node.value));
    if (!value)
        diagnostics.error(node.place, fmt::format("'{}' is {}; expected {}", parameter.name,
                                                  description(node), constraint_text(parameter)));
    return value;
}

}  // namespace candela
