#include "support/random_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <stdexcept>
#include <string_view>
#include <variant>

#include "support/plugins.h"

using candela::Parameter;
using candela::ParamType;
using candela::PluginKind;
using candela::Vec3;

namespace {

using Entries = std::vector<std::pair<std::string, std::string>>;

/// The distance that a shape extends from its origin, in units of its largest length.
float reach_of(const std::string& shape, const std::map<std::string, double>& lengths) {
    const auto length = [&](const char* name) { return static_cast<float>(lengths.at(name)); };
    if (shape == "sphere") return length("radius");
    if (shape == "torus") return length("major_radius") + length("minor_radius");
    if (shape == "cube") return length("size") * std::numbers::sqrt3_v<float> / 2;
    if (shape == "teapot") return length("size") * 1.4f;  // Newell: 3.15 high, spout 3.43 from the axis
    throw std::out_of_range("unknown bounds of " + shape);
}

class Generator {
  public:
    explicit Generator(unsigned seed) : random_(seed) {}

    RandomScene generate() {
        make_grid();
        add_table({"", {{"version", "1"}}});
        add_room();
        add_observer();
        if (chance(0.8)) add_image();
        const int lights = whole(0, 5), objects = whole(0, 6);
        const bool has_shading = chance(0.8), has_reflection = chance(0.8);
        if (has_shading) add_table({"[shading]", {{"model", word(any_of(PluginKind::shading))}}});
        default_reflection_ = any_of(PluginKind::reflection);
        if (has_reflection) add_table({"[reflection]", {{"model", word(default_reflection_)}}});
        for (int i = 0; i < lights; ++i) add_light(i);
        for (int i = 0; i < objects; ++i) add_object(i, has_shading, has_reflection);
        return std::move(scene_);
    }

  private:
    double number(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
    int whole(int low, int high) { return std::uniform_int_distribution(low, high)(random_); }
    bool chance(double probability) { return number(0, 1) < probability; }
    template <class List>
    const auto& one_of(const List& list) {
        return list[static_cast<std::size_t>(whole(0, static_cast<int>(std::size(list)) - 1))];
    }
    std::string any_of(PluginKind kind) { return one_of(test_registry().names(kind)); }

    /// A number in one of the notations that people use. All of them are exact.
    std::string real(double x) {
        if (x == std::floor(x) && std::abs(x) < 1e6 && chance(0.5)) return fmt::format("{:.0f}", x);
        if (chance(0.2)) return fmt::format("{:.17e}", x);
        const std::string digits = fmt::format("{}", x);
        return digits.find_first_of(".e") == std::string::npos ? digits + ".0" : digits;
    }
    std::string real(float x) { return real(static_cast<double>(x)); }
    std::string three(Vec3 v) { return fmt::format("[{}, {}, {}]", real(v.x), real(v.y), real(v.z)); }

    /// A string as TOML: with short or long escapes, or unescaped.
    std::string word(std::string_view text) {
        const int way = whole(0, 2);
        if (way == 0 &&
            std::ranges::all_of(text, [](char c) { return c >= ' ' && c != '\'' && c != '\x7f'; })) {
            return fmt::format("'{}'", text);
        }
        std::string result = "\"";
        for (const char c : text) {
            const auto code = static_cast<unsigned char>(c);
            if (code < 0x20 || code == 0x7f || c == '"' || c == '\\' || (way == 1 && code < 0x80)) {
                result += chance(0.5) ? fmt::format("\\u{:04X}", code) : fmt::format("\\U{:08X}", code);
            } else {
                result += c;
            }
        }
        return result + '"';
    }

    std::string strange_name(int index) {
        constexpr std::array<std::string_view, 24> k_parts = {
            "lamp", "number 1", "\"", "'", "\\", "\n", "\r", "\t",   "\b", "\f",       "\x01",    "\x1b[31m",
            "\x7f", "#",        "=",  "]", ".",  " ",  "é",  "日本", "🫖", "\xc2\x85", "\\u0041", "%s{}"};
        std::string name;
        for (int i = whole(0, 4); i > 0; --i) name += one_of(k_parts);
        // Unique, even without the characters that a terminal does not show.
        return name + std::to_string(index);
    }

    void make_grid() {
        if (chance(0.7)) {
            has_room_ = true;
            scene_.width = static_cast<float>(number(2, 30));
            scene_.height = static_cast<float>(number(2, 30));
            scene_.depth = static_cast<float>(number(2, 30));
        }
        cells_.resize(std::size_t{k_cells} * k_cells * k_cells);
        for (std::size_t i = 0; i < cells_.size(); ++i) cells_[i] = static_cast<int>(i);
        std::shuffle(cells_.begin(), cells_.end(), random_);
    }
    Vec3 cell_size() const {
        return {scene_.width / k_cells, scene_.height / k_cells, scene_.depth / k_cells};
    }
    float cell_radius() const {
        return 0.5f * std::min({scene_.width, scene_.height, scene_.depth}) / k_cells;
    }
    /// The middle of a cell that is then taken.
    Vec3 take_cell() {
        const int cell = cells_.back();
        cells_.pop_back();
        const auto along = [](int i, float size) {
            return (static_cast<float>(i) - (k_cells - 1) / 2.0f) * size;
        };
        const Vec3 size = cell_size();
        return {along(cell % k_cells, size.x), along(cell / k_cells % k_cells, size.y),
                along(cell / k_cells / k_cells, size.z)};
    }
    /// A random point in a cell, not at its border.
    Vec3 place_in_a_cell() {
        const Vec3 center = take_cell(), size = cell_size();
        const auto near = [&](float x, float s) { return x + s * static_cast<float>(number(-0.45, 0.45)); };
        return {near(center.x, size.x), near(center.y, size.y), near(center.z, size.z)};
    }

    void add_table(SceneTable table) {
        std::shuffle(table.entries.begin(), table.entries.end(), random_);
        scene_.tables.push_back(std::move(table));
    }

    void add_room() {
        if (!has_room_) {
            if (chance(0.3)) add_table({"[room]"});
            return;
        }
        add_table({"[room]",
                   {{"height", real(scene_.height)},
                    {"width", real(scene_.width)},
                    {"depth", real(scene_.depth)}}});
    }

    void add_observer() {
        scene_.observer = place_in_a_cell();
        const Vec3 look_at = place_in_a_cell();
        const Vec3 view = candela::normalized(look_at - scene_.observer);
        Entries entries = {{"position", three(scene_.observer)}, {"look_at", three(look_at)}};
        if (candela::length(candela::cross(view, {0, 1, 0})) < 0.1f || chance(0.5)) {
            Vec3 up = vector(-2, 2);
            while (candela::length(candela::cross(candela::normalized(up), view)) < 0.1f) up = vector(-2, 2);
            entries.emplace_back("up", three(up));
        }
        const bool orthographic = chance(0.3);
        if (orthographic || chance(0.3)) {
            entries.emplace_back("projection", orthographic ? "\"orthographic\"" : "\"perspective\"");
        }
        // Sometimes the one without effect, which draws a warning.
        if (chance(orthographic ? 0.1 : 0.7)) entries.emplace_back("fov", real(number(1, 179)));
        if (chance(orthographic ? 0.7 : 0.1)) entries.emplace_back("height", real(number(0.1, 20)));
        add_table({"[observer]", std::move(entries)});
    }

    Vec3 vector(double low, double high) {
        const auto x = [&] { return static_cast<float>(number(low, high)); };
        return {x(), x(), x()};
    }
    std::string color() {
        const auto channel = [&] { return chance(0.2) ? (chance(0.5) ? 0 : 255) : whole(0, 255); };
        return fmt::format("[{}, {}, {}]", channel(), channel(), channel());
    }

    void add_image() {
        Entries entries;
        if (chance(0.7)) entries.emplace_back("width", std::to_string(whole(1, 64)));
        if (chance(0.7)) entries.emplace_back("height", std::to_string(whole(1, 64)));
        if (chance(0.7)) entries.emplace_back("samples", one_of(std::array{"1", "4", "8", "16"}));
        if (chance(0.5)) entries.emplace_back("background", color());
        if (chance(0.5)) entries.emplace_back("color_management", chance(0.5) ? "\"srgb\"" : "\"none\"");
        add_table({"[image]", std::move(entries)});
    }

    /// A value within its parameter's range, sometimes at one of its ends.
    double real_of(const Parameter& p) {
        const bool has_low = p.minimum != candela::k_no_minimum,
                   has_high = p.maximum != candela::k_no_maximum;
        // A limit is the decimal number that describes it: 1e20, not the float nearest to that.
        const auto decimal = [](float limit) { return std::stod(fmt::format("{}", limit)); };
        const double low = has_low ? decimal(p.minimum) : -100;
        const double high = has_high ? decimal(p.maximum) : low + std::pow(10, number(-3, 4));
        if (has_low && !p.minimum_excluded && chance(0.1)) return low;
        if (has_high && !p.maximum_excluded && chance(0.1)) return high;
        return low + (high - low) * number(0.001, 0.999);
    }

    std::string value_of(const Parameter& p) {
        switch (p.type) {
            case ParamType::real:
                return real(real_of(p));
            case ParamType::integer: {
                if (!p.choices.empty()) return one_of(p.choices);
                const int low = p.minimum == candela::k_no_minimum ? -5 : static_cast<int>(p.minimum);
                // Few segments, so that tests stay quick.
                const int high = p.maximum == candela::k_no_maximum ? low + 9 : static_cast<int>(p.maximum);
                return std::to_string(whole(low, std::min(high, low + 9)));
            }
            case ParamType::boolean:
                return chance(0.5) ? "true" : "false";
            case ParamType::choice:
                return word(one_of(p.choices));
            case ParamType::text:
                return word(strange_name(0));
            case ParamType::color:
                return color();
            case ParamType::rgb: {
                if (chance(0.5)) return real(real_of(p));
                const auto channel = [&] { return static_cast<float>(real_of(p)); };
                return three({channel(), channel(), channel()});
            }
            case ParamType::point:
            case ParamType::vector:
                return three(vector(-2, 2));
            case ParamType::direction:
                return three(vector(0.1, 3));
            case ParamType::matrix:
                return fmt::format("[{}, {}, {}]", three(vector(-2, 2)), three(vector(-2, 2)),
                                   three(vector(-2, 2)));
            case ParamType::numbers:
                return fmt::format("[{}, {}]", real(real_of(p)), real(real_of(p)));
            case ParamType::file:
                break;
        }
        throw std::out_of_range("no random " + p.name);
    }

    /// Values for a plugin's parameters; some of those with defaults are omitted.
    Entries parameters_of(const candela::PluginFile& plugin) {
        Entries entries;
        for (const Parameter& p : plugin.manifest.parameters) {
            // No file is needed.
            if (p.type == ParamType::file && p.default_value) continue;
            if (!p.default_value || chance(0.6)) entries.emplace_back(p.name, value_of(p));
        }
        for (const candela::Relation& relation : plugin.manifest.relations) {
            if (!relation.only_warns) settle(relation, plugin.manifest.parameters, entries);
        }
        return entries;
    }

    /// Makes two numbers satisfy their relation: both from one draw, the smaller one first.
    void settle(const candela::Relation& relation, const std::vector<Parameter>& parameters,
                Entries& entries) {
        std::erase_if(entries,
                      [&](const auto& e) { return e.first == relation.left || e.first == relation.right; });
        if (chance(0.3)) return;  // the defaults satisfy it
        const auto larger = std::ranges::find(parameters, relation.right, &Parameter::name);
        const double right = real_of(*larger);
        entries.emplace_back(relation.left, real(right * number(0.1, 0.9)));
        entries.emplace_back(relation.right, real(right));
    }

    void add_light(int index) {
        const candela::PluginFile& plugin =
            test_registry().require(PluginKind::light, any_of(PluginKind::light));
        SceneTable table{"[[light]]", parameters_of(plugin)};
        table.set("type", word(plugin.manifest.name));
        if (chance(0.7)) table.set("name", word(strange_name(index)));
        if (table.find("position") != nullptr) {
            const Vec3 position = place_in_a_cell();
            table.set("position", three(position));
            scene_.light_positions.push_back(position);
        }
        add_table(std::move(table));
    }

    void add_object(int index, bool has_shading, bool has_reflection) {
        const std::string shape = one_of(std::array{"sphere", "cube", "torus", "teapot"});
        const candela::PluginFile& plugin = test_registry().require(PluginKind::shape, shape);
        SceneTable table{"[[object]]", parameters_of(plugin)};
        std::map<std::string, double> lengths;
        for (const Parameter& p : plugin.manifest.parameters) {
            if (p.type != ParamType::real) continue;
            const std::string* const given = table.find(p.name);
            lengths[p.name] = given != nullptr ? std::stod(*given) : std::get<double>(*p.default_value);
        }
        table.set("type", word(shape));
        if (chance(0.7)) table.set("name", word(strange_name(index)));
        if (chance(0.5)) table.set("rotation", three(vector(-360, 360)));
        if (chance(0.7)) table.set("color", color());
        fit(table, reach_of(shape, lengths));

        std::string reflection = default_reflection_;
        if (!has_shading || chance(0.3)) table.set("shading", word(any_of(PluginKind::shading)));
        if (!has_reflection || chance(0.3)) {
            reflection = any_of(PluginKind::reflection);
            table.set("reflection", word(reflection));
        }
        add_table(std::move(table));
        if (chance(0.3)) return;
        add_table({"[object.material]",
                   parameters_of(test_registry().require(PluginKind::reflection, reflection))});
    }

    /// Scales an object so that it fits its cell in any orientation.
    void fit(SceneTable& table, float reach) {
        const Vec3 center = take_cell();
        float radius = cell_radius() * static_cast<float>(number(0.2, 0.95));
        const float scale = radius / reach;
        if (scale > 1 && chance(0.5)) {
            radius = reach;  // it fits without scaling
        } else if (chance(0.5)) {
            table.set("scale", real(scale));
        } else {
            const auto part = [&] { return scale * static_cast<float>(number(0.2, 1)); };
            table.set("scale", three({part(), part(), part()}));
        }
        table.set("position", three(center));
        scene_.objects.push_back({center, radius});
    }

    static constexpr int k_cells = 4;  // along each side of the room

    std::mt19937 random_;
    RandomScene scene_;
    bool has_room_ = false;
    std::vector<int> cells_;  // free ones
    std::string default_reflection_;
};

}  // namespace

const std::string* SceneTable::find(const std::string& key) const {
    const auto found = std::ranges::find(entries, key, &std::pair<std::string, std::string>::first);
    return found != entries.end() ? &found->second : nullptr;
}

void SceneTable::set(const std::string& key, const std::string& value) {
    erase(key);
    entries.emplace_back(key, value);
}

void SceneTable::erase(const std::string& key) {
    std::erase_if(entries, [&](const auto& entry) { return entry.first == key; });
}

std::string RandomScene::text() const {
    std::string result;
    for (const SceneTable& table : tables) {
        if (!table.header.empty()) result += fmt::format("{}\n", table.header);
        for (const auto& [key, value] : table.entries) result += fmt::format("{} = {}\n", key, value);
    }
    return result;
}

std::size_t RandomScene::count(const std::string& header) const {
    return static_cast<std::size_t>(std::ranges::count(tables, header, &SceneTable::header));
}

SceneTable& RandomScene::table(const std::string& header, std::size_t index) {
    for (SceneTable& table : tables) {
        if (table.header == header && index-- == 0) return table;
    }
    throw std::out_of_range("there are too few " + header);
}

RandomScene random_scene(unsigned seed) { return Generator(seed).generate(); }
