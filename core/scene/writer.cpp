module;

#include <fmt/format.h>

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

import candela.api;
import candela.plugins;
import candela.util;

namespace candela {

namespace {

[[noreturn]] void cannot_say(const std::string& what) {
    throw Error(ErrorCategory::failure, "the scene cannot be written as a file: " + what);
}

std::string vector_text(Vec3 v) {
    return fmt::format("[{}, {}, {}]", toml_text(v.x), toml_text(v.y), toml_text(v.z));
}

std::string color_text(Vec3 color) {
    for (const float channel : {color.x, color.y, color.z}) {
        if (channel != std::floor(channel))
            cannot_say(fmt::format("{} in a colour is not an integer", channel));
    }
    return fmt::format("[{:.0f}, {:.0f}, {:.0f}]", color.x, color.y, color.z);
}

std::string rgb_text(Vec3 v) { return v.x == v.y && v.y == v.z ? toml_text(v.x) : vector_text(v); }

std::string value_text(const Value& value, ParamType type) {
    if (const auto* const boolean = std::get_if<bool>(&value)) return *boolean ? "true" : "false";
    if (const auto* const integer = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *integer);
    if (const auto* const real = std::get_if<double>(&value)) return toml_text(*real);
    if (const auto* const text = std::get_if<std::string>(&value)) return toml_text(*text);
    if (const auto* const m = std::get_if<Matrix>(&value)) {
        const auto row = [&](std::size_t i) { return vector_text({(*m)[i], (*m)[i + 1], (*m)[i + 2]}); };
        return fmt::format("[{}, {}, {}]", row(0), row(3), row(6));
    }
    if (const auto* const list = std::get_if<NumberList>(&value)) {
        std::string text;
        for (const float x : *list) text += (text.empty() ? "" : ", ") + toml_text(x);
        return fmt::format("[{}]", text);
    }
    const Vec3 v = std::get<Vec3>(value);
    return type == ParamType::color ? color_text(v) : type == ParamType::rgb ? rgb_text(v) : vector_text(v);
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
        write_room(scene.room);
        write_observer(scene.observer);
        write_image(scene.image);
        write_constraints(scene.constraints);
        if (scene.animation) write_animation(*scene.animation);
        if (!scene.objects.empty()) {
            shading_ = shared_shading(scene.objects);
            reflection_ = most_common(scene.objects, &Object::reflection).name;
            begin("[shading]");
            add("model", toml_text(shading_.name));
            add_parameters(shading_.parameters, "[shading]");
            end();
            begin("[reflection]");
            add("model", toml_text(reflection_));
            end();
        }
        for (std::size_t i = 0; i < scene.lights.size(); ++i) write_light(scene.lights[i], i);
        for (std::size_t i = 0; i < scene.objects.size(); ++i) write_object(scene.objects[i], i);
        return std::move(text_);
    }

  private:
    void begin(std::string_view title) { text_ += fmt::format("\n{}\n", title); }
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

    void add_parameters(const ParamSet& values, const std::string& where) {
        for (std::size_t i = 0; i < values.schema().size(); ++i) {
            const Parameter& p = values.schema()[i];
            const std::optional<Value>& value = values.get(i);
            if (!value) cannot_say(fmt::format("{}: '{}' has no value", where, p.name));
            // An optional file without a value is omitted.
            const auto* const file = p.type == ParamType::file ? std::get_if<std::string>(&*value) : nullptr;
            if (file == nullptr || !file->empty()) add(p.name, value_text(*value, p.type));
        }
    }

    void write_room(const Room& room) {
        begin("[room]");
        add("height", toml_text(room.height));
        add("width", toml_text(room.width));
        add("depth", toml_text(room.depth));
        end();
    }

    void write_observer(const Observer& observer) {
        const Observer standard;
        const bool perspective = observer.projection == Projection::perspective;
        begin("[observer]");
        add("position", vector_text(observer.position));
        add("look_at", vector_text(observer.look_at));
        add("up", vector_text(observer.up));
        add("projection", perspective ? "\"perspective\"" : "\"orthographic\"");
        // A value without effect draws a warning; but if it was set, it is written again.
        if (perspective || observer.fov != standard.fov) add("fov", toml_text(observer.fov));
        if (!perspective || observer.height != standard.height) add("height", toml_text(observer.height));
        if (observer.frame_aspect != standard.frame_aspect)
            add("frame_aspect", toml_text(observer.frame_aspect));
        end();
    }

    void write_image(const ImageSettings& image) {
        begin("[image]");
        add("width", fmt::format("{}", image.width));
        add("height", fmt::format("{}", image.height));
        add("samples", fmt::format("{}", image.samples));
        add("background", color_text(image.background));
        if (!image.environment.empty()) add("environment", toml_text(image.environment));
        add("color_management", image.color_management == ColorEncoding::srgb ? "\"srgb\"" : "\"none\"");
        end();
    }

    void write_constraints(const ConstraintSettings& constraints) {
        begin("[constraints]");
        add("overlap", !constraints.overlap                     ? "\"allow\""
                       : constraints.overlap == Severity::error ? "\"error\""
                                                                : "\"warn\"");
        end();
    }

    void write_animation(const Animation& animation) {
        begin("[animation]");
        add("frames", fmt::format("{}", animation.frames));
        add("fps", toml_text(animation.fps));
        end();
        if (animation.orbit) {
            begin("[animation.orbit]");
            add("turns", toml_text(animation.orbit->turns));
            end();
        }
        for (const Track& track : animation.tracks) {
            std::string keys;
            for (const Key& key : track.keys) {
                keys += fmt::format("{}[{}, {}]", keys.empty() ? "" : ", ", toml_text(key.time),
                                    value_text(key.value, track.type));
            }
            begin("[[animation.track]]");
            add("path", toml_text(track.path));
            add("keys", fmt::format("[{}]", keys));
            add("interpolation", toml_text(name_of(track.interpolation)));
            end();
        }
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

    void add_name(const Label& label, std::size_t index) {
        if (label.name.empty() && label.number != index)
            cannot_say(fmt::format("{} has the index {} and no name", label.text(), index));
        if (!label.name.empty()) add("name", toml_text(label.name));
    }

    void write_light(const LightSource& light, std::size_t index) {
        begin("[[light]]");
        add_name(light.label, index);
        add("type", toml_text(light.model.name));
        add_parameters(light.model.parameters, light.label.text());
        end();
    }

    void write_object(const Object& object, std::size_t index) {
        begin("[[object]]");
        add_name(object.label, index);
        add("type", toml_text(object.shape.name));
        add_parameters(object.shape.parameters, object.label.text());
        add("position", vector_text(object.transform.position));
        add("rotation", vector_text(object.transform.rotation));
        add("scale", rgb_text(object.transform.scale));
        add("color", color_text(object.color));
        if (!object.color_texture.empty()) add("color_texture", toml_text(object.color_texture));
        if (object.color_texture_wrap == TextureWrap::clamp) add("color_texture_wrap", "\"clamp\"");
        add("encloses", object.encloses ? "true" : "false");
        if (object.shading != shading_) add("shading", toml_text(object.shading.name));
        if (object.reflection.name != reflection_) add("reflection", toml_text(object.reflection.name));
        end();
        if (object.reflection.parameters.schema().empty()) return;
        text_ += "[object.material]\n";
        add_parameters(object.reflection.parameters, object.label.text());
        end();
    }

    std::string text_;
    std::vector<std::pair<std::string, std::string>> entries_;  // of the table being written
    Model shading_;
    std::string reflection_;
};

}  // namespace

std::string scene_text(const Scene& scene) { return Writer().write(scene); }

}  // namespace candela
