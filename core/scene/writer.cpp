module;

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

module candela.scene;

import :fields;
import candela.api;
import candela.plugins;
import candela.util;

namespace candela {

namespace {

[[noreturn]] void cannot_say(const std::string& what) {
    throw Error(ErrorCategory::failure, "the scene cannot be written as a file: " + what);
}

std::string value_text(const Value& value, ParamType type) {
    if (type == ParamType::color) {
        const Vec3 color = std::get<Vec3>(value);
        for (const float channel : {color.x, color.y, color.z}) {
            if (channel != std::floor(channel))
                cannot_say(fmt::format("{} in a colour is not an integer", channel));
        }
    }
    return toml_text(value, type);
}

/// Whether the model has only default parameters.
bool is_plain(const Model& model) { return model.parameters == ParamSet(model.parameters.schema()); }

/// The model of most objects, so that few need to name one.
const Model& most_common(const std::vector<Object>& objects, Model Object::* model) {
    std::map<std::string_view, std::size_t> counts;
    for (const Object& object : objects) ++counts[(object.*model).name];
    const auto count = [&](const Object& object) { return counts.at((object.*model).name); };
    return (*std::ranges::max_element(objects, {}, count)).*model;
}

class Writer {
  public:
    std::string write(const Scene& scene) {
        text_ = "version = 1\n";
        write(own_tables().room, scene.room);
        write(own_tables().observer, scene.observer);
        write(own_tables().image, scene.image);
        write(own_tables().constraints, scene.constraints);
        if (scene.shadows != ShadowSettings{}) write(own_tables().shadows, scene.shadows);
        if (scene.animation) write_animation(*scene.animation);
        if (!scene.objects.empty()) {
            shading_ = shared_shading(scene.objects);
            reflection_ = most_common(scene.objects, &Object::reflection).name;
            begin(own_tables().shading.about());
            for (const Field<Model>& field : own_tables().shading.fields()) add(field, shading_);
            add_parameters(shading_.parameters, own_tables().shading.about().title);
            end();
            write(own_tables().reflection, Model{.name = reflection_, .parameters = {}});
        }
        for (std::size_t i = 0; i < scene.lights.size(); ++i) write_light(scene.lights[i], i);
        for (std::size_t i = 0; i < scene.objects.size(); ++i) write_object(scene.objects[i], i);
        return std::move(text_);
    }

  private:
    void begin(const TableSchema& table) { text_ += fmt::format("\n{}\n", table.title); }
    void add(std::string_view key, std::string value) {
        entries_.emplace_back(toml_key(key), std::move(value));
    }
    /// Writes the added entries, with the equals signs aligned.
    void end() {
        std::size_t longest = 0;
        for (const auto& [key, value] : entries_) longest = std::max(longest, key.size());
        for (const auto& [key, value] : entries_) text_ += fmt::format("{:<{}} = {}\n", key, longest, value);
        entries_.clear();
    }

    /// `written`: the author's text for some of them.
    void add_parameters(const ParamSet& values, const std::string& where,
                        const std::map<std::string, std::string>& written = {}) {
        for (std::size_t i = 0; i < values.schema().size(); ++i) {
            const Parameter& p = values.schema()[i];
            const std::optional<Value>& value = values.get(i);
            if (const auto text = written.find(p.name); text != written.end()) {
                add(p.name, text->second);
                continue;
            }
            if (!value) cannot_say(fmt::format("{}: '{}' has no value", where, p.name));
            // An optional file without a value is omitted.
            const auto* const file = p.type == ParamType::file ? std::get_if<std::string>(&*value) : nullptr;
            if (file == nullptr || !file->empty()) add(p.name, value_text(*value, p.type));
        }
    }

    /// Adds the value, unless the scene is the same without it.
    template <class T>
    void add(const Field<T>& field, const T& from) {
        const Parameter& p = field.parameter;
        const Value value = field.get(from);
        // A value without effect draws a warning; but if it was set, it is written again.
        const bool is_optional = !field.is_written || p.type == ParamType::file ||
                                 (field.has_no_effect != nullptr && field.has_no_effect(from));
        if (!is_optional || value != p.default_value) add(p.name, value_text(value, p.type));
    }

    template <class T>
    void write(const Table<T>& table, const T& from) {
        begin(table.about());
        for (const Field<T>& field : table.fields()) add(field, from);
        end();
    }

    void write_animation(const Animation& animation) {
        write(own_tables().animation, animation);
        if (animation.orbit) write(own_tables().orbit, *animation.orbit);
        for (const Track& track : animation.tracks) {
            begin(own_tables().track.about());
            for (const Field<Track>& field : own_tables().track.fields()) {
                if (field.get)
                    add(field, track);
                else
                    add(field.parameter.name, keys_text(track));
            }
            end();
        }
    }

    static std::string keys_text(const Track& track) {
        std::string keys;
        for (const Key& key : track.keys) {
            keys += fmt::format("{}[{}, {}]", keys.empty() ? "" : ", ", toml_text(key.time),
                                value_text(key.value, track.type));
        }
        return fmt::format("[{}]", keys);
    }

    /// The model of [shading]. Only that table can set parameters of a shading model: an object that names a
    /// model gets its defaults.
    static Model shared_shading(const std::vector<Object>& objects) {
        const Object* told = nullptr;
        for (const Object& object : objects) {
            if (is_plain(object.shading)) continue;
            if (told == nullptr) told = &object;
            if (told->shading != object.shading) {
                cannot_say(
                    fmt::format("objects {} and {} have shading models with different parameters, but "
                                "[shading] can hold only one",
                                told->label.text(), object.label.text()));
            }
        }
        return told != nullptr ? told->shading : most_common(objects, &Object::shading);
    }

    static void require_index(const Label& label, std::size_t index) {
        if (label.name.empty() && label.number != index)
            cannot_say(fmt::format("{} has the index {} and no name", label.text(), index));
    }

    void write_light(const LightSource& light, std::size_t index) {
        require_index(light.label, index);
        begin(own_tables().light.about());
        for (const Field<LightSource>& field : own_tables().light.fields()) add(field, light);
        add_parameters(light.model.parameters, light.label.text(), light.written);
        end();
    }

    void write_object(const Object& object, std::size_t index) {
        require_index(object.label, index);
        begin(own_tables().object.about());
        for (const Field<Object>& field : own_tables().object.fields()) {
            const std::string& key = field.parameter.name;
            if (key == "shading" && object.shading == shading_) continue;
            if (key == "reflection" && object.reflection.name == reflection_) continue;
            if (key == "color" && object.color_texture) {
                add(key, text_of(*object.color_texture));
                continue;
            }
            add(field, object);
            if (key == "type") add_parameters(object.shape.parameters, object.label.text());
        }
        if (object.normal_map) {
            const NormalMap& map = *object.normal_map;
            const Table<NormalMap>& keys = map.has_heights ? own_tables().bump_map : own_tables().normal_map;
            add(keys.about().name, inline_table(keys, map, map.placing.transform));
        }
        end();
        if (object.reflection.parameters.schema().empty() && object.common == CommonMaterial{}) return;
        text_ += "[object.material]\n";
        add_parameters(object.reflection.parameters, object.label.text(), texts_of(object.textures));
        const std::map<std::string, std::string> textures = texts_of(object.common.textures);
        for (const Field<CommonMaterial>& field : own_tables().material.fields()) {
            const auto texture = textures.find(field.parameter.name);
            if (texture != textures.end())
                add(texture->first, texture->second);
            else
                add(field, object.common);
        }
        end();
    }

    static std::map<std::string, std::string> texts_of(const std::vector<ParameterTexture>& textures) {
        std::map<std::string, std::vector<std::string>> factors;
        for (const ParameterTexture& texture : textures)
            factors[texture.parameter].push_back(text_of(texture));
        std::map<std::string, std::string> texts;
        for (const auto& [parameter, tables] : factors)
            texts.emplace(parameter,
                          tables.size() == 1 ? tables.front() : fmt::format("[{}]", fmt::join(tables, ", ")));
        return texts;
    }

    static std::string text_of(const ParameterTexture& texture) {
        return inline_table(texture.attribute.empty() ? own_tables().texture : own_tables().attribute,
                            texture, texture.placing.transform);
    }

    /// An inline table of what differs from the defaults.
    template <class T>
    static std::string inline_entries(const Table<T>& table, const T& from) {
        std::string entries;
        for (const Field<T>& field : table.fields()) {
            const Value value = field.get(from);
            if (value == field.parameter.default_value) continue;
            entries += fmt::format("{}{} = {}", entries.empty() ? "" : ", ", field.parameter.name,
                                   value_text(value, field.parameter.type));
        }
        return entries;
    }

    template <class T>
    static std::string inline_table(const Table<T>& table, const T& from, const TextureTransform& placing) {
        std::string entries = inline_entries(table, from);
        const std::string transform = inline_entries(own_tables().texture_transform, placing);
        if (!transform.empty()) entries += fmt::format(", transform = {{ {} }}", transform);
        return fmt::format("{{ {} }}", entries);
    }

    std::string text_;
    std::vector<std::pair<std::string, std::string>> entries_;  // of the table being written
    Model shading_;
    std::string reflection_;
};

}  // namespace

std::string scene_text(const Scene& scene) { return Writer().write(scene); }

}  // namespace candela
