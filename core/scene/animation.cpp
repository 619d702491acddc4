// Reads [animation], and checks it as far as possible without the frames.
module;

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

module candela.scene;

import :animating;
import :fields;
import :models;
import :setting;
import :tables;
import candela.plugins;
import candela.util;

namespace candela {

namespace {

bool is_element(const std::vector<std::string>& parts) {
    return parts.size() > 1 && (parts[0] == "light" || parts[0] == "object");
}

/// Paths of the same value become equal: lights and objects are numbered.
std::vector<std::string> canonical_parts(std::string_view path, const ElementIndex& elements) {
    std::vector<std::string> parts = parts_of(path);
    if (!is_element(parts)) return parts;
    if (const auto index = elements.find(parts[0], parts[1])) parts[1] = std::to_string(*index);
    return parts;
}

/// Whether `path` is `outer`, or leads into the table at `outer`.
bool is_within(const std::vector<std::string>& path, const std::vector<std::string>& outer) {
    return std::ranges::mismatch(outer, path).in1 == outer.end();
}

std::optional<std::string> text_in(const TableNode* table, std::string_view key) {
    const TableNode::Entry* const entry = table != nullptr ? table->find(key) : nullptr;
    const auto* const text = entry != nullptr ? std::get_if<std::string>(&entry->node.value) : nullptr;
    return text != nullptr ? std::optional(*text) : std::nullopt;
}

bool changes_in_steps_only(const Parameter& p) {
    return p.type == ParamType::boolean || p.type == ParamType::choice || p.type == ParamType::text ||
           p.type == ParamType::file || !p.choices.empty();
}

class AnimationReader {
  public:
    AnimationReader(SceneTables& tables, const SceneRequest& request)
        : tables_(tables), request_(request), diagnostics_(tables.diagnostics()), elements_(tables.root()) {}

    std::optional<Animation> read() {
        const std::size_t errors = diagnostics_.error_count();
        const TableNode* const table = tables_.single("animation");
        if (table == nullptr) return std::nullopt;
        const TableSchema& schema = own_tables().animation.about();
        std::vector<std::string> keys = names_in(schema.parameters);
        for (const TableSchema& inner : schema.tables) keys.push_back(inner.name);
        const TableContext context = tables_.context_of("animation");
        report_unknown_keys(*table, keys, context, diagnostics_);
        read(*table, own_tables().animation, context, animation_);
        if (const TableNode::Entry* const orbit = table->find("orbit")) read_orbit(*orbit);
        if (const TableNode::Entry* const tracks = table->find("track")) read_tracks(*tracks);
        if (diagnostics_.error_count() != errors) return std::nullopt;
        return std::move(animation_);
    }

  private:
    void read_orbit(const TableNode::Entry& entry) {
        const TableNode* const table = entry.node.table();
        if (table == nullptr) {
            diagnostics_.error(
                entry.key_place,
                fmt::format("'orbit' is {}; expected the table [animation.orbit]", description(entry.node)));
            return;
        }
        const TableSchema& schema = own_tables().orbit.about();
        const TableContext context{schema.title, {}, entry.key_place};
        report_unknown_keys(*table, names_in(schema.parameters), context, diagnostics_);
        read(*table, own_tables().orbit, context, animation_.orbit.emplace());
    }

    template <class T>
    void read(const TableNode& node, const Table<T>& table, const TableContext& context, T& to) {
        table.assign(&node, read_parameters(node, table.schema(), context, diagnostics_).set, to);
    }

    void read_tracks(const TableNode::Entry& entry) {
        const ArrayNode* const all = entry.node.array();
        if (all == nullptr ||
            !std::ranges::all_of(*all, [](const Node& node) { return node.table() != nullptr; })) {
            diagnostics_.error(entry.key_place,
                               fmt::format("'track' is {}; expected tables, each headed [[animation.track]]",
                                           description(entry.node)));
            return;
        }
        for (const Node& node : *all) read_track(*node.table(), node.place);
    }

    void read_track(const TableNode& table, const SourceLocation& place) {
        const TableSchema& schema = own_tables().track.about();
        const TableContext context{schema.title, {}, place};
        report_unknown_keys(table, names_in(schema.parameters), context, diagnostics_);
        Track track;
        read(table, own_tables().track, context, track);
        const TableNode::Entry* const keys = table.find("keys");
        if (keys == nullptr) {
            diagnostics_.error(place, fmt::format("{} has no 'keys': a list of [time, value]", schema.title),
                               "for example: keys = [[0.0, 1.0], [2.5, 3.0]]");
        }
        const TableNode::Entry* const path = table.find("path");
        if (path == nullptr || !std::holds_alternative<std::string>(path->node.value)) return;
        const SourceLocation& path_place = path->node.place;
        const auto parameter = parameter_at(track.path, path_place);
        if (!parameter || keys == nullptr) return;
        track.type = parameter->type;
        read_keys(keys->node, *parameter, track);
        if (track.keys.empty()) return;
        if (track.interpolation != Interpolation::step) check_interpolation(table, *parameter, track);
        if (!is_overridden(track.path, path_place)) animation_.tracks.push_back(std::move(track));
    }

    void read_keys(const Node& node, const Parameter& parameter, Track& track) {
        const ArrayNode* const keys = node.array();
        if (keys == nullptr || keys->empty()) {
            diagnostics_.error(node.place,
                               fmt::format("'keys' is {}; expected a list of [time, value]",
                                           keys == nullptr ? description(node) : "an empty list"),
                               "for example: keys = [[0.0, 1.0], [2.5, 3.0]]");
            return;
        }
        for (const Node& key : *keys) {
            const ArrayNode* const pair = key.array();
            if (pair == nullptr || pair->size() != 2) {
                diagnostics_.error(
                    key.place, pair == nullptr
                                   ? fmt::format("a key is {}; expected [time, value]", description(key))
                                   : fmt::format("a key has {} value{}; expected [time, value]", pair->size(),
                                                 pair->size() == 1 ? "" : "s"));
                continue;
            }
            const auto time = time_of((*pair)[0]);
            auto value = valid_value((*pair)[1], parameter, diagnostics_);
            if (!time || !value) continue;
            if (!track.keys.empty() && *time <= track.keys.back().time) {
                diagnostics_.error((*pair)[0].place,
                                   fmt::format("the key at {} s does not come after the one at {} s", *time,
                                               track.keys.back().time),
                                   "the times of a track's keys must increase");
                continue;
            }
            track.keys.push_back({*time, *std::move(value), (*pair)[1].place});
        }
    }

    std::optional<double> time_of(const Node& node) {
        Parameter time;
        time.name = "time";
        time.unit = "s";
        constexpr float k_longest = 1e9f;
        time.minimum = -k_longest;
        time.maximum = k_longest;
        const auto value = valid_value(node, time, diagnostics_);
        return value ? std::optional(std::get<double>(*value)) : std::nullopt;
    }

    void check_interpolation(const TableNode& table, const Parameter& parameter, const Track& track) {
        const TableNode::Entry* const stated = table.find("interpolation");
        const SourceLocation& place = stated != nullptr ? stated->node.place : table.find("path")->node.place;
        if (changes_in_steps_only(parameter)) {
            diagnostics_.error(
                place, fmt::format("'{}' cannot be interpolated: {}", track.path, constraint_text(parameter)),
                "write: interpolation = \"step\"");
        } else if (const auto* const first = std::get_if<NumberList>(&track.keys.front().value)) {
            const auto has_another_length = [&](const Key& key) {
                return std::get<NumberList>(key.value).size() != first->size();
            };
            const auto other = std::ranges::find_if(track.keys, has_another_length);
            if (other == track.keys.end()) return;
            diagnostics_.error(other->place, "this list and that of the first key have different lengths",
                               "write: interpolation = \"step\"");
        }
    }

    /// The path of a track that changes the same value, a part of it, or a table that contains it; or null.
    const std::string* track_of(const std::vector<std::string>& parts) const {
        std::vector<std::string> outer;
        for (const std::string& part : parts) {
            outer.push_back(part);
            if (const auto found = tracks_.find(outer); found != tracks_.end()) return &found->second;
        }
        // Paths that begin with these parts come directly after them.
        const auto next = tracks_.lower_bound(parts);
        return next != tracks_.end() && is_within(next->first, parts) ? &next->second : nullptr;
    }

    /// Whether a setting or another track overrides the track.
    bool is_overridden(const std::string& path, const SourceLocation& place) {
        const std::vector<std::string> parts = canonical_parts(path, elements_);
        if (const std::string* const other = track_of(parts)) {
            diagnostics_.error(place, fmt::format("another track changes '{}' already", *other),
                               "put all keys into one of them");
        } else {
            tracks_.emplace(parts, path);
        }
        const bool moves_observer = parts[0] == "observer" && parts.back() == "position";
        if (animation_.orbit && moves_observer) {
            diagnostics_.error(place, "[animation.orbit] determines the observer's position already",
                               "remove it, or this track");
        }
        std::string by;
        for (const Setting& setting : request_.settings) {
            if (is_within(parts, canonical_parts(setting.path, elements_))) by = setting.origin;
        }
        for (const auto* const chosen : {&request_.shading, &request_.reflection}) {
            const char* const name = chosen == &request_.shading ? "shading" : "reflection";
            const bool chooses = parts.back() == name || (parts[0] == name && parts.size() == 2);
            if (*chosen && chooses) by = (*chosen)->origin;
        }
        if (by.empty()) return false;
        diagnostics_.warning(place,
                             fmt::format("the track of '{}' has no effect: {} overrides it", path, by));
        return true;
    }

    /// The parameter at a path. Nothing if there is none, which is reported, or if its plugin is not
    /// installed, which is reported with the table that names it.
    std::optional<Parameter> parameter_at(const std::string& path, const SourceLocation& place) {
        const std::vector<std::string> parts = canonical_parts(path, elements_);
        if (!leads_somewhere(parts, place)) return std::nullopt;
        const auto schema = std::ranges::find(scene_schema(), parts[0], &TableSchema::name);
        if (parts[0] == "animation" || parts[0] == "include" || parts[0] == "version") {
            diagnostics_.error(place, fmt::format("'{}' cannot be animated", path));
            return std::nullopt;
        }
        if (schema == scene_schema().end()) {
            std::vector<std::string> names;
            for (const TableSchema& table : scene_schema()) names.push_back(table.name);
            diagnostics_.error(place, fmt::format("a scene has no table '{}'", parts[0]),
                               suggestion(parts[0], names));
            return std::nullopt;
        }
        if (parts[0] == "image" && (parts[1] == "width" || parts[1] == "height")) {
            diagnostics_.error(place, "all frames must have the same size",
                               fmt::format("set it once, as {} in [image]", parts[1]));
            return std::nullopt;
        }
        return parameter_in(*schema, path, parts, place);
    }

    /// Reports a path that cannot be set, by trying it on a copy of the table that contains it. A copy of the
    /// whole scene for each track would take minutes if there are thousands.
    bool leads_somewhere(const std::vector<std::string>& parts, const SourceLocation& place) {
        TableNode scratch;
        if (const TableNode::Entry* const entry = tables_.root().find(parts[0])) {
            const ArrayNode* const all = entry->node.array();
            const auto index =
                is_element(parts) && all != nullptr ? elements_.find(parts[0], parts[1]) : std::nullopt;
            if (index) {
                scratch.entries.push_back(
                    {entry->key, entry->key_place, {entry->node.place, ArrayNode{(*all)[*index]}}});
                std::vector<std::string> inner = parts;
                inner[1] = "0";
                return set_value(scratch, inner, Node{place, false}, place, diagnostics_);
            }
            if (parts[0] != "animation" || parts.size() < 2) scratch.entries.push_back(*entry);
        }
        return set_value(scratch, parts, Node{place, false}, place, diagnostics_);
    }

    std::optional<Parameter> parameter_in(const TableSchema& schema, const std::string& path,
                                          const std::vector<std::string>& parts,
                                          const SourceLocation& place) {
        const std::size_t own = schema.repeated ? 2 : 1;  // offset of the table's keys in the path
        const TableNode* const table = table_at(parts, schema.repeated);
        std::vector<std::string> known;
        if (parts.size() == own + 1) {
            if (const Parameter* const p = parameter_named(schema.parameters, parts[own])) return *p;
            known = names_in(schema.parameters);
        }
        bool is_uncertain = false;  // whether a plugin that is not installed might know the key
        for (const PluginKey& key : schema.plugins) {
            if (!key.parameters_in) continue;
            const bool is_nested = !key.parameters_in->empty();
            if (is_nested && parts.size() == own + 1) known.push_back(*key.parameters_in);
            if (parts.size() != own + (is_nested ? 2 : 1)) continue;
            if (is_nested && parts[own] != *key.parameters_in) continue;
            const PluginFile* const plugin = plugin_of(key, table);
            if (plugin == nullptr) {
                is_uncertain = true;
                continue;
            }
            if (const Parameter* const p = parameter_named(*plugin->schema, parts.back())) {
                Parameter value = *p;
                // The angles of the cone, on which a flux depends, may change as well.
                if (value.notation == Notation::cone) value.notation = Notation::plain;
                return value;
            }
            known = names_in(*plugin->schema, std::move(known));
            if (is_nested && key.kind == PluginKind::reflection) {
                if (const Parameter* const p = parameter_named(material_schema().parameters, parts.back()))
                    return *p;
                known = names_in(material_schema().parameters, std::move(known));
            }
            // A model chosen on the command line need not have the parameters of the scene's own.
            if (key.kind == PluginKind::reflection && request_.reflection) is_uncertain = true;
        }
        if (is_uncertain) return std::nullopt;
        diagnostics_.error(
            place, fmt::format("'{}' does not lead to a value: there is no key '{}'", path, parts.back()),
            suggestion(parts.back(), known));
        return std::nullopt;
    }

    const TableNode* table_at(const std::vector<std::string>& parts, bool is_element) const {
        const TableNode::Entry* const entry = tables_.root().find(parts[0]);
        if (entry == nullptr || !is_element) return entry != nullptr ? entry->node.table() : nullptr;
        const ArrayNode* const all = entry->node.array();
        const auto index = all != nullptr ? elements_.find(parts[0], parts[1]) : std::nullopt;
        return index ? (*all)[*index].table() : nullptr;
    }

    const PluginFile* plugin_of(const PluginKey& key, const TableNode* table) {
        auto name = text_in(table, key.key);
        const std::string shared = key.kind == PluginKind::shading ? "shading" : "reflection";
        const auto& chosen = key.kind == PluginKind::shading ? request_.shading : request_.reflection;
        if (key.kind == PluginKind::shading || key.kind == PluginKind::reflection) {
            const TableNode::Entry* const entry = tables_.root().find(shared);
            if (chosen) {
                name = chosen->name;
            } else if (!name && entry != nullptr) {
                name = text_in(entry->node.table(), "model");
            }
            if (!name) name = key.kind == PluginKind::shading ? k_default_shading : k_default_reflection;
        }
        return name ? tables_.registry().find(key.kind, *name) : nullptr;
    }

    SceneTables& tables_;
    const SceneRequest& request_;
    Diagnostics& diagnostics_;
    ElementIndex elements_;
    Animation animation_;
    std::map<std::vector<std::string>, std::string> tracks_;  // canonical parts to the path as written
};

}  // namespace

std::optional<Animation> read_animation(SceneTables& tables, const SceneRequest& request) {
    return AnimationReader(tables, request).read();
}

}  // namespace candela
