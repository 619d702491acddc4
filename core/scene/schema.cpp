// The scene file's own keys, typed in the same way as plugins' parameters.
module;

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

module candela.scene;

import candela.api;
import candela.plugins;

namespace candela {

namespace {

using Type = ParamType;

constexpr const char* k_projections[] = {"perspective", "orthographic"};
constexpr const char* k_wraps[] = {"repeat", "clamp"};
constexpr const char* k_encodings[] = {"srgb", "none"};
constexpr const char* k_sample_counts[] = {"1", "4", "8", "16"};

constexpr const char* k_severities[] = {"error", "warn", "allow"};
constexpr const char* k_versions[] = {"1"};

constexpr ParamSpec k_top[] = {
    {.name = "version",
     .type = Type::integer,
     .meaning = "version of the scene file's format; required, exactly once across all files",
     .required = true,
     .choices = k_versions},
    {.name = "include",
     .type = Type::file,
     .meaning = "files to include; relative to this one, each at most once"},
};
constexpr ParamSpec k_room[] = {
    {.name = "height",
     .unit = "m",
     .meaning = "from floor to ceiling (y)",
     .default_value = {{10}},
     .minimum = 0,
     .minimum_excluded = true},
    {.name = "width",
     .unit = "m",
     .meaning = "from left to right (x)",
     .default_value = {{10}},
     .minimum = 0,
     .minimum_excluded = true},
    {.name = "depth",
     .unit = "m",
     .meaning = "from front to back (z)",
     .default_value = {{10}},
     .minimum = 0,
     .minimum_excluded = true},
};
constexpr ParamSpec k_observer[] = {
    {.name = "position",
     .type = Type::point,
     .unit = "m",
     .meaning = "the observer's position",
     .required = true},
    {.name = "look_at",
     .type = Type::point,
     .unit = "m",
     .meaning = "the point at the centre of the picture",
     .required = true},
    {.name = "up",
     .type = Type::direction,
     .meaning = "the up direction of the picture",
     .default_value = {{0, 1, 0}}},
    {.name = "projection",
     .type = Type::choice,
     .meaning = "perspective or orthographic projection",
     .choices = k_projections},
    {.name = "fov",
     .unit = "deg",
     .meaning = "perspective: the full vertical angle of view",
     .default_value = {{40}},
     .minimum = 0,
     .maximum = 180,
     .minimum_excluded = true,
     .maximum_excluded = true},
    {.name = "height",
     .unit = "m",
     .meaning = "orthographic: height of the picture in metres",
     .default_value = {{4}},
     .minimum = 0,
     .minimum_excluded = true},
    {.name = "frame_aspect",
     .meaning = "aspect ratio (width to height) of the frame that every picture shows completely: narrower "
                "pictures show more above and below, wider ones more at the sides; 0: no frame, and narrower "
                "pictures show less at the sides",
     .default_value = {{0}},
     .minimum = 0},
};
constexpr ParamSpec k_image[] = {
    {.name = "width",
     .type = Type::integer,
     .meaning = "pixels from left to right",
     .default_value = {.integer = 512},
     .minimum = 1,
     .maximum = 65536},
    {.name = "height",
     .type = Type::integer,
     .meaning = "pixels from top to bottom",
     .default_value = {.integer = 512},
     .minimum = 1,
     .maximum = 65536},
    {.name = "samples",
     .type = Type::integer,
     .meaning = "samples per pixel, for anti-aliasing",
     .default_value = {.integer = 1},
     .choices = k_sample_counts},
    {.name = "background",
     .type = Type::color,
     .meaning = "colour where there is no object",
     .default_value = {{0, 0, 0}}},
    {.name = "environment",
     .type = Type::file,
     .meaning = "an equirectangular environment map, visible where there is no object and in objects that "
                "mirror or refract; replaces background",
     .default_value = {.text = ""}},
    {.name = "color_management",
     .type = Type::choice,
     .meaning = "\"srgb\": colours are decoded, light is added up linearly, 8-bit pictures are encoded "
                "again; \"none\": values are used as they are",
     .choices = k_encodings},
};
constexpr ParamSpec k_constraints[] = {
    {.name = "overlap",
     .type = Type::choice,
     .meaning = "how overlapping objects are treated: error, warn or allow; scenes made for other programs "
                "may need warn or allow",
     .choices = k_severities},
};
constexpr ParamSpec k_shading[] = {
    {.name = "model",
     .type = Type::text,
     .meaning = "default shading plugin; its parameters may follow",
     .required = true},
};
constexpr ParamSpec k_reflection[] = {
    {.name = "model", .type = Type::text, .meaning = "default reflection plugin", .required = true},
};
constexpr ParamSpec k_light[] = {
    {.name = "name", .type = Type::text, .meaning = "unique; names it in messages and settings"},
    {.name = "type", .type = Type::text, .meaning = "light plugin; its parameters follow", .required = true},
};
constexpr ParamSpec k_object[] = {
    {.name = "name", .type = Type::text, .meaning = "unique; names it in messages and settings"},
    {.name = "type", .type = Type::text, .meaning = "shape plugin; its parameters follow", .required = true},
    {.name = "position",
     .type = Type::point,
     .unit = "m",
     .meaning = "the position of the shape's origin",
     .default_value = {}},
    {.name = "rotation",
     .type = Type::vector,
     .unit = "deg",
     .meaning = "about x, then y, then z (fixed axes)",
     .default_value = {}},
    {.name = "scale",
     .type = Type::rgb,
     .meaning = "before rotation; one number or three",
     .default_value = {{1, 1, 1}},
     .minimum = 0,
     .minimum_excluded = true},
    {.name = "color",
     .type = Type::color,
     .meaning = "colour of the surface",
     .default_value = {{200, 200, 200}}},
    {.name = "color_texture",
     .type = Type::file,
     .meaning = "a picture that multiplies the colour, placed by the shape's texture coordinates",
     .default_value = {.text = ""}},
    {.name = "color_texture_wrap",
     .type = Type::choice,
     .meaning = "beyond the edges of color_texture: repeat the picture, or continue the colours at its edges",
     .choices = k_wraps},
    {.name = "encloses",
     .type = Type::boolean,
     .meaning = "whether lights, the observer and other objects may be inside, as in a room or a lampshade; "
                "the object is then drawn from both sides",
     .default_value = {}},
    {.name = "shading", .type = Type::text, .meaning = "shading plugin; overrides [shading]"},
    {.name = "reflection", .type = Type::text, .meaning = "reflection plugin; overrides [reflection]"},
};

constexpr const char* k_interpolations[] = {"linear", "step", "smooth"};
constexpr ParamSpec k_animation[] = {
    {.name = "frames",
     .type = Type::integer,
     .meaning = "number of frames, numbered from 0",
     .required = true,
     .minimum = 1,
     .maximum = 1'000'000},
    {.name = "fps",
     .meaning = "frames per second: frame i is at i / fps seconds",
     .default_value = {{24}},
     .minimum = 0,
     .maximum = 1000,
     .minimum_excluded = true},
};
constexpr ParamSpec k_orbit[] = {
    {.name = "turns",
     .meaning = "over all frames; counter-clockwise seen from above, clockwise if negative",
     .default_value = {{1}},
     .minimum = -1'000'000,
     .maximum = 1'000'000},
};
constexpr ParamSpec k_track[] = {
    {.name = "path",
     .type = Type::text,
     .meaning = R"(what changes, as --set names it: "light.lamp.intensity", "object.0.rotation")",
     .required = true},
    {.name = "keys",
     .type = Type::numbers,
     .meaning = "seconds, strictly increasing, and the value at that time; constant before the first key and "
                "after the last",
     .required = true},
    {.name = "interpolation",
     .type = Type::choice,
     .meaning = "between keys: in a straight line; not at all, until the next key; or along a Catmull-Rom "
                "spline through all keys, which may exceed their values",
     .choices = k_interpolations},
};

TableSchema table(std::string_view name, std::string_view title, std::string_view meaning,
                  std::span<const ParamSpec> specs, std::vector<PluginKey> plugins = {}) {
    TableSchema result{std::string(name), std::string(title), std::string(meaning), {}};
    result.repeated = title.starts_with("[[");
    result.plugins = std::move(plugins);
    for (const ParamSpec& spec : specs) result.parameters.push_back(parameter_of(spec));
    return result;
}

}  // namespace

const TableSchema& top_schema() {
    static const TableSchema k_table = [] {
        TableSchema result = table("", "the top of the file", "keys before all tables", k_top);
        result.lists = {"include"};
        return result;
    }();
    return k_table;
}

std::span<const TableSchema> scene_schema() {
    static const TableSchema k_animation_table = [] {
        TableSchema animation =
            table("animation", "[animation]", "makes the scene a film; optional (docs/user/animation.md)",
                  k_animation);
        animation.tables = {table("orbit", "[animation.orbit]",
                                  "moves the observer around its look-at point, about its 'up', back to the "
                                  "start after the last frame; optional",
                                  k_orbit),
                            table("track", "[[animation.track]]",
                                  "one value of the scene that changes over time; any number", k_track)};
        animation.tables.back().timed = {"keys"};
        return animation;
    }();
    static const std::array k_tables = {
        table("room", "[room]", "a box centred on the origin that contains everything; optional", k_room),
        table("observer", "[observer]", "who sees the scene; required, exactly once across all files",
              k_observer),
        table("image", "[image]", "the picture; optional", k_image),
        table("constraints", "[constraints]", "how strict the checks of the whole scene are; optional",
              k_constraints),
        table("shading", "[shading]", "how normals are found; if omitted, Candela asks", k_shading,
              {{"model", PluginKind::shading, ""}}),
        table("reflection", "[reflection]", "how light is reflected; if omitted, Candela asks", k_reflection,
              {{"model", PluginKind::reflection}}),
        table("light", "[[light]]", "a light; any number", k_light, {{"type", PluginKind::light, ""}}),
        table("object", "[[object]]",
              "an object; any number. [object.material] holds the parameters of its reflection model",
              k_object,
              {{"type", PluginKind::shape, ""},
               {"shading", PluginKind::shading},
               {"reflection", PluginKind::reflection, "material"}}),
        k_animation_table,
    };
    return k_tables;
}

}  // namespace candela
