module;

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <string_view>

module candela.scene;

import :schema;
import :vocabulary;
import candela.plugins;

namespace candela {

namespace {

struct Word {
    std::string_view table, key;
    std::string_view hint;  // the intended key; a whole sentence if it contains a space
};

constexpr std::string_view k_material = "material";

constexpr std::string_view k_lights = "write a [[light]] for each";
constexpr std::string_view k_objects = "write an [[object]] for each";
constexpr std::string_view k_observer_table = "the camera is the table [observer]";
constexpr std::string_view k_materials = "a material is the table [object.material], below its [[object]]";
constexpr std::string_view k_size = "write width and height";
constexpr std::string_view k_name_of_image = "-o gives the picture's name and format";
constexpr std::string_view k_of_object =
    "it belongs in [[object]], such as normal_map = { texture = \"n.png\" }";
constexpr std::string_view k_parameter_texture =
    "write a table in [object.material], such as roughness = { texture = \"r.png\" }";
constexpr std::string_view k_color_texture = "write color = { texture = \"a.png\" }";
constexpr std::string_view k_clamped_texture = R"(write color = { texture = "a.png", wrap = "clamp" })";
constexpr std::string_view k_color_of_object =
    "the colour is the object's: color = { texture = \"a.png\" } in [[object]]";
constexpr std::string_view k_shape_size = "an object's size is its 'scale'";
constexpr std::string_view k_camera_settings = "write exposure = { aperture = 8, time = 0.008, iso = 200 }";
constexpr std::string_view k_cone = "write inner_angle and outer_angle, half-angles in degrees";

constexpr auto k_words = std::to_array<Word>({
    {"", "camera", k_observer_table},
    {"", "cameras", k_observer_table},
    {"", "view", k_observer_table},
    {"", "viewer", k_observer_table},
    {"", "eye", k_observer_table},
    {"", "lights", k_lights},
    {"", "lamp", k_lights},
    {"", "lamps", k_lights},
    {"", "point_light", k_lights},
    {"", "ambient", "write a [[light]] with type = \"ambient\""},
    {"", "ambient_light", "write a [[light]] with type = \"ambient\""},
    {"", "objects", k_objects},
    {"", "shapes", k_objects},
    {"", "shape", k_objects},
    {"", "mesh", k_objects},
    {"", "meshes", k_objects},
    {"", "model", k_objects},
    {"", "sphere", k_objects},
    {"", "cube", k_objects},
    {"", "material", k_materials},
    {"", "materials", k_materials},
    {"", "resolution", "[image] has width and height"},
    {"", "size", "[image] has width and height"},
    {"", "film", "the picture's settings are in [image]"},
    {"", "output", "the picture's settings are in [image]"},
    {"", "render", "the picture's settings are in [image]"},
    {"", "renderer", "the picture's settings are in [image]"},
    {"", "settings", "the picture's settings are in [image]"},
    {"", "sky", "[image] has 'environment'"},
    {"", "shadow", "[shadows] has 'enabled'"},
    {"shadows", "enable", "enabled"},
    {"shadows", "on", "enabled"},
    {"shadows", "cast", "enabled"},
    {"shadows", "cast_shadows", "enabled"},
    {"light", "cast_shadow", "casts_shadows"},
    {"light", "cast_shadows", "casts_shadows"},
    {"light", "castshadow", "casts_shadows"},
    {"light", "shadow", "casts_shadows"},
    {"light", "shadows", "casts_shadows"},
    {"light", "shadowless", "casts_shadows"},
    {"light", "visible", "background"},
    {"light", "is_background", "background"},
    {"light", "show_background", "background"},
    {"light", "ambient_occlusion", "ambient_occlusion_rays"},
    {"light", "ao", "ambient_occlusion_rays"},
    {"object", "cast_shadow", "casts_shadows"},
    {"object", "cast_shadows", "casts_shadows"},
    {"object", "castshadow", "casts_shadows"},
    {"object", "no_shadow", "casts_shadows"},
    {"object", "receive_shadow", "receives_shadows"},
    {"object", "receive_shadows", "receives_shadows"},
    {"object", "receiveshadow", "receives_shadows"},
    {"observer", "eye", "position"},
    {"observer", "pos", "position"},
    {"observer", "from", "position"},
    {"observer", "origin", "position"},
    {"observer", "location", "position"},
    {"observer", "target", "look_at"},
    {"observer", "lookat", "look_at"},
    {"observer", "look", "look_at"},
    {"observer", "at", "look_at"},
    {"observer", "to", "look_at"},
    {"observer", "center", "look_at"},
    {"observer", "focus", "look_at"},
    {"observer", "direction", "look_at"},
    {"observer", "forward", "look_at"},
    {"observer", "up_vector", "up"},
    {"observer", "upvector", "up"},
    {"observer", "vup", "up"},
    {"observer", "fovy", "fov"},
    {"observer", "fov_y", "fov"},
    {"observer", "yfov", "fov"},
    {"observer", "field_of_view", "fov"},
    {"observer", "angle", "fov"},
    {"observer", "zoom", "fov"},
    {"observer", "type", "projection"},
    {"observer", "aspect", "the picture's width and height, in [image], determine that"},
    {"observer", "aspect_ratio", "the picture's width and height, in [image], determine that"},
    {"observer", "ev", "exposure"},
    {"observer", "ev100", "exposure"},
    {"observer", "aperture", k_camera_settings},
    {"observer", "f_number", k_camera_settings},
    {"observer", "shutter", k_camera_settings},
    {"observer", "iso", k_camera_settings},
    {"observer", "near", "nothing is too near or too far to be drawn"},
    {"observer", "far", "nothing is too near or too far to be drawn"},
    {"image", "size", k_size},
    {"image", "resolution", k_size},
    {"image", "res", k_size},
    {"image", "xres", "width"},
    {"image", "yres", "height"},
    {"image", "w", "width"},
    {"image", "h", "height"},
    {"image", "spp", "samples"},
    {"image", "aa", "samples"},
    {"image", "msaa", "samples"},
    {"image", "antialiasing", "samples"},
    {"image", "anti_aliasing", "samples"},
    {"image", "samples_per_pixel", "samples"},
    {"image", "bg", "background"},
    {"image", "background_color", "background"},
    {"image", "clear_color", "background"},
    {"image", "sky", "environment"},
    {"image", "skybox", "environment"},
    {"image", "envmap", "environment"},
    {"image", "environment_map", "environment"},
    {"image", "hdri", "environment"},
    {"image", "gamma", "color_management"},
    {"image", "color_space", "color_management"},
    {"image", "tone_map", "tone"},
    {"image", "tonemap", "tone"},
    {"image", "tone_mapping", "tone"},
    {"image", "tonemapping", "tone"},
    {"image", "tone_curve", "tone"},
    {"image", "tonemapper", "tone"},
    {"image", "ev", "[observer] has 'exposure'"},
    {"image", "file", k_name_of_image},
    {"image", "filename", k_name_of_image},
    {"image", "format", k_name_of_image},
    {"image", "name", k_name_of_image},
    {"image", "output", k_name_of_image},
    {"light", "pos", "position"},
    {"light", "location", "position"},
    {"light", "dir", "direction"},
    {"light", "target", "direction"},
    {"light", "look_at", "direction"},
    {"light", "brightness", "intensity"},
    {"light", "energy", "intensity"},
    {"light", "power", "intensity"},
    {"light", "strength", "intensity"},
    {"light", "cutoff", k_cone},
    {"light", "angle", k_cone},
    {"light", "cone_angle", k_cone},
    {"light", "kelvin", "temperature"},
    {"light", "color_temperature", "temperature"},
    {"light", "colour_temperature", "temperature"},
    {"light", "lumens", "write intensity = \"800 lm\""},
    {"light", "lumen", "write intensity = \"800 lm\""},
    {"light", "lux", "write intensity = \"5 klx\""},
    {"light", "candela", "write intensity = \"1200 cd\""},
    {"light", "watts", "write intensity = \"60 W\""},
    {"light", "decay", "attenuation"},
    {"light", "kind", "type"},
    {"object", "pos", "position"},
    {"object", "location", "position"},
    {"object", "origin", "position"},
    {"object", "center", "position"},
    {"object", "centre", "position"},
    {"object", "translate", "position"},
    {"object", "translation", "position"},
    {"object", "rotate", "rotation"},
    {"object", "orientation", "rotation"},
    {"object", "size", k_shape_size},
    {"object", "radius", k_shape_size},
    {"object", "width", k_shape_size},
    {"object", "height", k_shape_size},
    {"object", "depth", k_shape_size},
    {"object", "length", k_shape_size},
    {"object", "side", k_shape_size},
    {"object", "texture", k_color_texture},
    {"object", "map", k_color_texture},
    {"object", "image", k_color_texture},
    {"object", "map_kd", k_color_texture},
    {"object", "albedo_texture", k_color_texture},
    {"object", "diffuse_map", k_color_texture},
    {"object", "diffuse_texture", k_color_texture},
    {"object", "base_color_texture", k_color_texture},
    {"object", "color_texture", k_color_texture},
    {"object", "color_texture_wrap", k_clamped_texture},
    {"object", "texture_wrap", k_clamped_texture},
    {"object", "bump", "bump_map"},
    {"object", "bump_texture", "bump_map"},
    {"object", "normal", "normal_map"},
    {"object", "normal_texture", "normal_map"},
    {"object", "metallic_texture", k_parameter_texture},
    {"object", "roughness_texture", k_parameter_texture},
    {"object", "specular_texture", k_parameter_texture},
    {"object", "albedo", "color"},
    {"object", "base_color", "color"},
    {"object", "diffuse_color", "color"},
    {"object", "diffuse", "its colour is 'color', and how much it scatters 'kd' in [object.material]"},
    {"object", "specular", "write ks in [object.material]"},
    {"object", "kind", "type"},
    {"object", "shape", "type"},
    {"object", "primitive", "type"},
    {"object", "geometry", "type"},
    {"object", "path", "file"},
    {"object", "filename", "file"},
    {"object", "src", "file"},
    {"material", "diffuse", "kd"},
    {"material", "specular", "ks"},
    {"material", "ambient", "ka"},
    {"material", "exponent", "shininess"},
    {"material", "specular_exponent", "shininess"},
    {"material", "gloss", "shininess"},
    {"material", "glossiness", "shininess"},
    {"material", "n", "shininess"},
    {"material", "ns", "shininess"},
    {"material", "index_of_refraction", "ior"},
    {"material", "refractive_index", "ior"},
    {"material", "eta", "ior"},
    {"material", "albedo", "the colour is the object's: 'color' in [[object]]"},
    {"material", "base_color", "the colour is the object's: 'color' in [[object]]"},
    {"material", "diffuse_color", "the colour is the object's: 'color' in [[object]]"},
    {"material", "texture", k_color_of_object},
    {"material", "map", k_color_of_object},
    {"material", "map_kd", k_color_of_object},
    {"material", "diffuse_texture", k_color_of_object},
    {"material", "color_texture", k_color_of_object},
    {"material", "metallic_texture", k_parameter_texture},
    {"material", "roughness_texture", k_parameter_texture},
    {"material", "specular_texture", k_parameter_texture},
    {"material", "bump", k_of_object},
    {"material", "bump_map", k_of_object},
    {"material", "normal_map", k_of_object},
    {"material", "normal_texture", k_of_object},
    {"material", "emissive", "emission"},
    {"material", "emissive_factor", "emission"},
    {"material", "emissive_color", "emission"},
    {"material", "emission_color", "emission"},
    {"material", "emissive_strength", "emission_strength"},
    {"material", "emissive_intensity", "emission_strength"},
    {"material", "emission_intensity", "emission_strength"},
    {"material", "emissive_texture", k_parameter_texture},
    {"material", "emission_texture", k_parameter_texture},
    {"material", "occlusion_texture", k_parameter_texture},
    {"material", "ao", "occlusion"},
    {"material", "alpha", "opacity"},
    {"material", "d", "opacity"},
    {"material", "alpha_cutoff", "opacity_cutoff"},
    {"material", "cutoff", "opacity_cutoff"},
    {"material", "alpha_test", "opacity_cutoff"},
    {"material", "alpha_map", k_parameter_texture},
    {"material", "opacity_map", k_parameter_texture},
    {"material", "opacity_texture", k_parameter_texture},
    {"material", "transparency", "it is one minus 'opacity'"},
    {"material", "ambient_occlusion", "occlusion"},
    {"material", "model", "the model is the object's: 'reflection' in [[object]]"},
    {"material", "type", "the model is the object's: 'reflection' in [[object]]"},
});

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return text;
}

bool has_key(const TableSchema& table, std::string_view key) {
    return std::ranges::find(table.parameters, key, &Parameter::name) != table.parameters.end();
}

bool is_of_a_reflection_model(std::string_view key, Registry& registry) {
    return std::ranges::any_of(registry.list(), [&](const PluginFile* plugin) {
        const auto& parameters = plugin->manifest.parameters;
        return plugin->manifest.kind == PluginKind::reflection &&
               std::ranges::find(parameters, key, &Parameter::name) != parameters.end();
    });
}

/// The table where a misplaced key belongs; empty if there is none.
std::string place_of_key(std::string_view table, const std::string& key, Registry& registry) {
    const auto belongs = [&](std::string_view where) {
        return fmt::format("'{}' belongs in {}", key, where);
    };
    if (table == k_material) {
        const auto object = std::ranges::find(scene_schema(), "object", &TableSchema::name);
        return has_key(*object, key) ? belongs("[[object]], above [object.material]") : "";
    }
    if (table != "light" && is_of_a_reflection_model(key, registry)) return belongs("[object.material]");
    for (const TableSchema& other : scene_schema()) {
        constexpr std::array<std::string_view, 3> k_single{"observer", "image", "room"};
        const bool is_named =
            other.name != table && std::ranges::find(k_single, other.name) != k_single.end();
        if (is_named && has_key(other, key)) return belongs(other.title);
    }
    return "";
}

}  // namespace

std::function<std::string(const std::string& key)> hints_for(std::string_view table, Registry& registry) {
    return [table = std::string(table), &registry](const std::string& key) {
        const std::string lower_key = lower(key);
        const auto word = std::ranges::find_if(
            k_words, [&](const Word& each) { return each.table == table && each.key == lower_key; });
        if (word == k_words.end()) return place_of_key(table, key, registry);
        const bool is_sentence = word->hint.find(' ') != std::string_view::npos;
        return is_sentence ? std::string(word->hint) : fmt::format("did you mean '{}'?", word->hint);
    };
}

}  // namespace candela
