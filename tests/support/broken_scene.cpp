#include "broken_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <variant>

#include "plugins.h"

import candela.scene;

namespace {

using candela::Parameter;
using candela::ParamType;
using candela::PluginKind;
using candela::Vec3;

/// The broken constraint and its position.
struct Change {
    std::string rule;
    std::string message;
    const SceneTable* table = nullptr;
    std::string key{};  // empty: the table's header, or no place
};

std::string three(const Vec3& v) {
    const auto real = [](float x) { return fmt::format("{:.9e}", x); };
    return fmt::format("[{}, {}, {}]", real(v.x), real(v.y), real(v.z));
}

class Breaker {
  public:
    explicit Breaker(unsigned seed) : random_(seed), scene_(random_scene(seed)) {}

    BrokenScene run() {
        using Rule = std::optional<Change> (Breaker::*)();
        static constexpr Rule k_rules[] = {
            &Breaker::version,         &Breaker::unknown_key,        &Breaker::unknown_plugin,
            &Breaker::missing_type,    &Breaker::below_range,        &Breaker::above_range,
            &Breaker::not_finite,      &Breaker::wrong_type,         &Breaker::wrong_color,
            &Breaker::wrong_choice,    &Breaker::relation,           &Breaker::zero_direction,
            &Breaker::zero_scale,      &Breaker::room_size,          &Breaker::image_size,
            &Breaker::sample_count,    &Breaker::field_of_view,      &Breaker::view_of_nothing,
            &Breaker::up_along_view,   &Breaker::observer_outside,   &Breaker::light_outside,
            &Breaker::object_outside,  &Breaker::light_at_light,     &Breaker::light_at_observer,
            &Breaker::light_in_object, &Breaker::observer_in_object, &Breaker::object_in_object,
            &Breaker::name_twice,      &Breaker::no_observer,        &Breaker::key_twice,
        };
        for (;;) {
            const Rule rule = k_rules[below(std::size(k_rules))];
            if (const auto change = (this->*rule)()) {
                return {change->rule, scene_.text(), change->message, line_of(*change)};
            }
        }
    }

  private:
    std::size_t below(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_); }
    template <class All>
    const auto& one_of(const All& all) {
        return all[below(all.size())];
    }

    int line_of(const Change& change) const {
        int line = 1;
        for (const SceneTable& table : scene_.tables) {
            if (&table == change.table && change.key.empty()) return line;
            if (!table.header.empty()) ++line;
            for (std::size_t i = 0; i < table.entries.size(); ++i, ++line) {
                const bool is_last =
                    std::none_of(table.entries.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                 table.entries.end(), [&](const auto& e) { return e.first == change.key; });
                if (&table == change.table && table.entries[i].first == change.key && is_last) return line;
            }
        }
        return 0;
    }

    SceneTable& any_table() { return scene_.tables[below(scene_.tables.size())]; }
    SceneTable* any_of(const std::string& header) {
        const std::size_t count = scene_.count(header);
        return count > 0 ? &scene_.table(header, below(count)) : nullptr;
    }
    /// The table with that header, added if the scene omits it.
    SceneTable& the(const std::string& header) {
        if (scene_.count(header) == 0) scene_.tables.push_back({header, {}});
        return scene_.table(header);
    }
    SceneTable& observer() { return scene_.table("[observer]"); }

    /// Lights that have a position, in the order of RandomScene::light_positions.
    std::vector<SceneTable*> placed_lights() {
        std::vector<SceneTable*> result;
        for (SceneTable& table : scene_.tables) {
            if (table.header == "[[light]]" && table.find("position") != nullptr) result.push_back(&table);
        }
        return result;
    }
    std::string type_of(const SceneTable& table) const {
        for (const PluginKind kind : {PluginKind::light, PluginKind::shape}) {
            if ((kind == PluginKind::light) != (table.header == "[[light]]")) continue;
            for (const candela::PluginFile* const plugin : test_registry().list()) {
                if (plugin->manifest.kind == kind &&
                    scene_text_is(*table.find("type"), plugin->manifest.name))
                    return plugin->manifest.name;
            }
        }
        return "";
    }
    /// Whether a TOML string, however it is written, is that word.
    static bool scene_text_is(const std::string& toml, const std::string& word) {
        candela::Diagnostics diagnostics;
        const auto node = candela::parse_value(toml, {}, diagnostics);
        const auto* const text = node ? std::get_if<std::string>(&node->value) : nullptr;
        return text != nullptr && *text == word;
    }

    /// A parameter of a random light or object, with the table that it belongs to.
    struct ParameterReference {
        SceneTable* table;
        Parameter parameter;
    };
    template <class Wanted>
    std::optional<ParameterReference> any_parameter(Wanted is_wanted) {
        std::vector<ParameterReference> all;
        for (SceneTable& table : scene_.tables) {
            const bool is_light = table.header == "[[light]]";
            if (!is_light && table.header != "[[object]]") continue;
            const auto& manifest =
                test_registry()
                    .require(is_light ? PluginKind::light : PluginKind::shape, type_of(table))
                    .manifest;
            for (const Parameter& p : manifest.parameters) {
                if (is_wanted(p)) all.push_back({&table, p});
            }
        }
        return all.empty() ? std::nullopt : std::optional(one_of(all));
    }
    std::optional<Change> spoil(const std::optional<ParameterReference>& place, const std::string& rule,
                                const std::string& value, const std::string& message) {
        if (!place) return std::nullopt;
        place->table->set(place->parameter.name, value);
        return Change{rule, message, place->table, place->parameter.name};
    }

    std::optional<Change> version() {
        SceneTable& root = the("");
        root.set("version", "2");
        return Change{"version", "does not support version 2 of the scene file", &root, "version"};
    }
    std::optional<Change> unknown_key() {
        SceneTable& table = any_table();
        table.set("no_such_key", "1");
        return Change{"unknown key", "unknown key 'no_such_key'", &table, "no_such_key"};
    }
    std::optional<Change> unknown_plugin() {
        SceneTable* const table = any_of(below(2) != 0 ? "[[light]]" : "[[object]]");
        if (table == nullptr) return std::nullopt;
        table->set("type", "\"no-such-thing\"");
        return Change{"unknown plugin", "plugin is called 'no-such-thing'", table, "type"};
    }
    std::optional<Change> missing_type() {
        SceneTable* const table = any_of(below(2) != 0 ? "[[light]]" : "[[object]]");
        if (table == nullptr) return std::nullopt;
        table->erase("type");
        return Change{"no type", "has no 'type'", table};
    }

    static bool is_number(const Parameter& p) {
        return p.choices.empty() && (p.type == ParamType::real || p.type == ParamType::integer);
    }
    std::optional<Change> below_range() {
        const auto place = any_parameter(
            [](const Parameter& p) { return is_number(p) && p.minimum != candela::k_no_minimum; });
        if (!place) return std::nullopt;
        const Parameter& p = place->parameter;
        const float value = p.type == ParamType::integer ? p.minimum - 1
                            : p.minimum_excluded         ? p.minimum
                                                         : p.minimum - 1e-3f;
        return spoil(place, "below range",
                     p.type == ParamType::integer ? fmt::format("{}", static_cast<int>(value))
                                                  : fmt::format("{:.9e}", value),
                     "is outside its range");
    }
    std::optional<Change> above_range() {
        const auto place = any_parameter(
            [](const Parameter& p) { return is_number(p) && p.maximum != candela::k_no_maximum; });
        if (!place) return std::nullopt;
        const Parameter& p = place->parameter;
        return spoil(place, "above range",
                     p.type == ParamType::integer ? fmt::format("{}", static_cast<int>(p.maximum) + 1)
                                                  : fmt::format("{:.9e}", p.maximum * 1.001f + 1e-3f),
                     "is outside its range");
    }
    std::optional<Change> not_finite() {
        const auto place = any_parameter([](const Parameter& p) { return p.type == ParamType::real; });
        return spoil(place, "not finite", below(2) != 0 ? "nan" : "-inf", "is not a usable number");
    }
    std::optional<Change> wrong_type() {
        const auto place =
            any_parameter([](const Parameter& p) { return p.choices.empty() && p.type != ParamType::file; });
        return spoil(place, "wrong type", "\"red\"", "is a string, \"red\"; expected");
    }
    std::optional<Change> wrong_choice() {
        const auto place = any_parameter([](const Parameter& p) { return p.type == ParamType::choice; });
        return spoil(place, "choice", "\"no-such-word\"", "\"no-such-word\" is not one of");
    }
    std::optional<Change> wrong_color() {
        const auto place = any_parameter([](const Parameter& p) { return p.type == ParamType::color; });
        return spoil(place, "color", "[0, 257, 0]", "257");
    }
    std::optional<Change> zero_direction() {
        const auto place = any_parameter([](const Parameter& p) { return p.type == ParamType::direction; });
        return spoil(place, "zero direction", "[0, 0.0, -0.0]", "zero");
    }
    std::optional<Change> relation() {
        for (SceneTable& table : scene_.tables) {
            const bool is_light = table.header == "[[light]]";
            if (!is_light && table.header != "[[object]]") continue;
            const std::string type = type_of(table);
            const auto& manifest =
                test_registry().require(is_light ? PluginKind::light : PluginKind::shape, type).manifest;
            for (const candela::Relation& relation : manifest.relations) {
                if (relation.only_warns) continue;
                table.set(relation.left, "0.5");
                table.set(relation.right, "0.4");
                return Change{"relation " + type, relation.left, &table, relation.left};
            }
        }
        return std::nullopt;
    }

    std::optional<Change> zero_scale() {
        SceneTable* const object = any_of("[[object]]");
        if (object == nullptr) return std::nullopt;
        object->set("scale", below(2) != 0 ? "0" : "[1, 0, 1]");
        return Change{"scale", "'scale'", object, "scale"};
    }
    std::optional<Change> room_size() {
        SceneTable& room = the("[room]");
        room.set("width", below(2) != 0 ? "0.0" : "-4");
        return Change{"room", "'width'", &room, "width"};
    }
    std::optional<Change> image_size() {
        SceneTable& image = the("[image]");
        image.set("height", below(2) != 0 ? "0" : "65537");
        return Change{"image size", "'height'", &image, "height"};
    }
    std::optional<Change> sample_count() {
        SceneTable& image = the("[image]");
        image.set("samples", "3");
        return Change{"samples", "'samples'", &image, "samples"};
    }
    std::optional<Change> field_of_view() {
        observer().set("fov", below(2) != 0 ? "0.0" : "180");
        return Change{"fov", "'fov'", &observer(), "fov"};
    }

    std::optional<Change> view_of_nothing() {
        observer().set("look_at", std::string(*observer().find("position")));
        return Change{"look_at", "the observer is at the point it looks at", &observer(), "look_at"};
    }
    std::optional<Change> up_along_view() {
        observer().set("position", "[0.0, 0.0, 0.0]");
        observer().set("look_at", "[0.0, 0.5, 1.0]");
        observer().set("up", "[0.0, -1.0, -2.0]");
        return Change{"up", "'up' is parallel to the viewing direction", &observer(), "up"};
    }
    std::optional<Change> observer_outside() {
        observer().set("position", three({0.01f, -scene_.height, 0.02f}));
        observer().set("look_at", "[1.0, 0.0, 1.5]");
        observer().erase("up");
        return Change{"observer outside", "the observer is not inside the room", &observer(), "position"};
    }
    std::optional<Change> light_outside() {
        const auto lights = placed_lights();
        if (lights.empty()) return std::nullopt;
        SceneTable* const light = one_of(lights);
        light->set("position", three({scene_.width, 0, 0}));
        return Change{"light outside", "is not inside the room", light, "position"};
    }
    std::optional<Change> object_outside() {
        SceneTable* const object = any_of("[[object]]");
        if (object == nullptr) return std::nullopt;
        object->set("position", three({0, 0, -scene_.depth}));
        return Change{"object outside", "is not wholly inside the room", object, "position"};
    }
    std::optional<Change> light_at_light() {
        const auto lights = placed_lights();
        if (lights.size() < 2) return std::nullopt;
        lights[1]->set("position", *lights[0]->find("position"));
        return Change{"light at light", "is at the same place as light", lights[1], "position"};
    }
    std::optional<Change> light_at_observer() {
        const auto lights = placed_lights();
        if (lights.empty()) return std::nullopt;
        SceneTable* const light = one_of(lights);
        light->set("position", *observer().find("position"));
        return Change{"light at observer", "is where the observer is", light, "position"};
    }

    /// Objects that enclose their centre.
    std::vector<std::size_t> full_objects() {
        std::vector<std::size_t> result;
        for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
            const std::string type = type_of(scene_.table("[[object]]", i));
            if (type == "sphere" || type == "cube") result.push_back(i);
        }
        return result;
    }
    std::optional<Change> light_in_object() {
        const auto lights = placed_lights();
        const auto objects = full_objects();
        if (lights.empty() || objects.empty()) return std::nullopt;
        SceneTable* const light = one_of(lights);
        light->set("position", three(scene_.objects[one_of(objects)].center));
        return Change{"light in object", "is inside object", light, "position"};
    }
    std::optional<Change> observer_in_object() {
        const auto objects = full_objects();
        if (objects.empty()) return std::nullopt;
        const Vec3 center = scene_.objects[one_of(objects)].center;
        observer().set("position", three(center));
        observer().set("look_at", three(center + Vec3{0, 0, 1}));
        observer().erase("up");
        return Change{"observer in object", "the observer is inside object", &observer(), "position"};
    }
    std::optional<Change> object_in_object() {
        const auto objects = full_objects();
        if (objects.size() < 2) return std::nullopt;
        SceneTable& second = scene_.table("[[object]]", objects[1]);
        second.set("position", three(scene_.objects[objects[0]].center));
        return Change{"overlap", "overlaps object", &second, "position"};
    }

    std::optional<Change> name_twice() {
        const std::string header = below(2) != 0 ? "[[light]]" : "[[object]]";
        if (scene_.count(header) < 2) return std::nullopt;
        scene_.table(header, 0).set("name", "\"same\"");
        SceneTable& second = scene_.table(header, 1);
        second.set("name", "'same'");
        return Change{"name twice", "is called 'same'", &second, "name"};
    }
    std::optional<Change> no_observer() {
        std::erase_if(scene_.tables, [](const SceneTable& t) { return t.header == "[observer]"; });
        return Change{"no observer", "the scene has no [observer]"};
    }
    std::optional<Change> key_twice() {
        SceneTable& image = the("[image]");
        image.set("width", "8");
        image.entries.emplace_back("width", "9");
        return Change{"key twice", "'width' is given twice", &image, "width"};
    }

    std::mt19937 random_;
    RandomScene scene_;
};

}  // namespace

BrokenScene broken_scene(unsigned seed) { return Breaker(seed).run(); }
