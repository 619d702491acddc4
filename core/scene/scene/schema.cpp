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

import candela.color;
import candela.math;
import candela.parameters;
import candela.registry;

namespace candela {

namespace {

using Type = ParamType;

constexpr const char* k_projections[] = {"perspective", "orthographic"};
constexpr const char* k_encodings[] = {"srgb", "none"};
constexpr const char* k_sample_counts[] = {"1", "4", "8", "16"};

constexpr const char* k_severities[] = {"error", "warn"};
constexpr const char* k_versions[] = {"1"};

constexpr ParamSpec k_top[] = {
    {.name = "version",
     .type = Type::integer,
     .meaning = "of the scene file's format; required, exactly once over all files",
     .required = true,
     .choices = k_versions},
    {.name = "include",
     .type = Type::file,
     .meaning = "files included here; relative to this one, each at most once"},
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
     .meaning = "where the observer is",
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
     .meaning = "orthographic: metres that fit the picture's height",
     .default_value = {{4}},
     .minimum = 0,
     .minimum_excluded = true},
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
     .meaning = "an equirectangular environment map, seen where there is no object and in objects that "
                "mirror or refract; replaces background",
     .default_value = {.text = ""}},
    {.name = "color_management",
     .type = Type::choice,
     .meaning = "\"srgb\": colours are decoded, light is added up in linear light, 8-bit pictures are "
                "encoded again; "
                "\"none\": values are used as they are",
     .choices = k_encodings},
};
constexpr ParamSpec k_constraints[] = {
    {.name = "overlap",
     .type = Type::choice,
     .meaning = "what objects that overlap are: an error, or a warning, for scenes that were made for other "
                "programs",
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
     .meaning = "where the shape's origin is",
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
    {.name = "encloses",
     .type = Type::boolean,
     .meaning = "whether lights, the observer and other objects may be inside, as in a room or a lampshade; "
                "it is then drawn "
                "from both sides",
     .default_value = {}},
    {.name = "shading", .type = Type::text, .meaning = "shading plugin; overrides [shading]"},
    {.name = "reflection", .type = Type::text, .meaning = "reflection plugin; overrides [reflection]"},
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
    static const std::array k_tables = {
        table("room", "[room]", "a box centred on the origin that contains everything; optional", k_room),
        table("observer", "[observer]", "who sees the scene; required, exactly once over all files",
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
    };
    return k_tables;
}

}  // namespace candela
