// The scene file's own tables and keys, typed in the same way as plugins' parameters.
module;

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

module candela.scene;

import :fields;
import :photometry;
import candela.api;
import candela.plugins;

namespace candela {

namespace {

using Type = ParamType;

constexpr const char* k_name = "unique; names it in messages and settings";

Table<Room> room() {
    return {{.name = "room",
             .title = "[room]",
             .meaning = "a box centred on the origin that contains everything; optional"},
            {field(Type::real, "height", "from floor to ceiling (y)", &Room::height).unit("m").above(0),
             field(Type::real, "width", "from left to right (x)", &Room::width).unit("m").above(0),
             field(Type::real, "depth", "from front to back (z)", &Room::depth).unit("m").above(0)}};
}

Table<Observer> observer() {
    return {{.name = "observer",
             .title = "[observer]",
             .meaning = "who sees the scene; required, exactly once across all files"},
            {field(Type::point, "position", "the observer's position", &Observer::position)
                 .unit("m")
                 .required()
                 .placed(&Observer::position_place),
             field(Type::point, "look_at", "the point at the centre of the picture", &Observer::look_at)
                 .unit("m")
                 .required(),
             field(Type::direction, "up", "the up direction of the picture", &Observer::up),
             choice({"perspective", "orthographic"}, "projection", "perspective or orthographic projection",
                    &Observer::projection),
             field(Type::real, "fov", "perspective: the full vertical angle of view", &Observer::fov)
                 .unit("deg")
                 .above(0)
                 .below(180)
                 .without_effect([](const Observer& o) { return o.projection == Projection::orthographic; }),
             field(Type::real, "height", "orthographic: height of the picture in metres", &Observer::height)
                 .unit("m")
                 .above(0)
                 .without_effect([](const Observer& o) { return o.projection == Projection::perspective; }),
             field(Type::real, "frame_aspect",
                   "aspect ratio (width to height) of the frame that every picture shows completely: "
                   "narrower pictures show more above and below, wider ones more at the sides; 0: no frame, "
                   "and narrower pictures show less at the sides",
                   &Observer::frame_aspect)
                 .minimum(0)
                 .omitted_by_default(),
             field(Type::real, "exposure",
                   "exposure value at ISO 100 of 8-bit pictures: intensities are divided by 1.2 * 2^EV; the "
                   "default "
                   "leaves them as they are (docs/user/light.md)",
                   &Observer::exposure)
                 .unit("EV")
                 .range(-24, 24)
                 .notation(Notation::exposure)
                 .omitted_by_default()}};
}

Table<ImageSettings> image() {
    return {
        {.name = "image", .title = "[image]", .meaning = "the picture; optional"},
        {field(Type::integer, "width", "pixels from left to right", &ImageSettings::width).range(1, 65536),
         field(Type::integer, "height", "pixels from top to bottom", &ImageSettings::height).range(1, 65536),
         field(Type::integer, "samples", "samples per pixel, for anti-aliasing", &ImageSettings::samples)
             .choices({"1", "4", "8", "16"}),
         field(Type::color, "background", "colour where there is no object", &ImageSettings::background),
         field(Type::file, "environment",
               "an equirectangular environment map, visible where there is no object and in objects that "
               "mirror or refract; replaces background",
               &ImageSettings::environment)
             .placed(&ImageSettings::environment_place),
         choice({"srgb", "none"}, "color_management",
                "\"srgb\": colours are decoded, light is added up linearly, 8-bit pictures are encoded "
                "again; \"none\": values are used as they are",
                &ImageSettings::color_management),
         choice({"none", "khronos-neutral", "aces", "agx", "reinhard"}, "tone",
                "the tone curve of 8-bit pictures, after exposure: none clamps what is brighter than white",
                &ImageSettings::tone)
             .omitted_by_default()}};
}

Table<ConstraintSettings> constraints() {
    return {{.name = "constraints",
             .title = "[constraints]",
             .meaning = "how strict the checks of the whole scene are; optional"},
            {choice({"error", "warn", "allow"}, "overlap",
                    "how overlapping objects are treated: error, warn or allow; scenes made for other "
                    "programs may need warn or allow",
                    &ConstraintSettings::overlap)}};
}

Table<ShadowSettings> shadows() {
    return {{.name = "shadows",
             .title = "[shadows]",
             .meaning = "light that objects block; optional, without it none is (docs/user/shadows.md)"},
            {field(Type::boolean, "enabled", "whether objects block light", &ShadowSettings::enabled),
             choice({"varied", "fixed"}, "pattern",
                    "where the samples of a light with an extent are: varied from pixel to pixel, so that "
                    "penumbras are smooth, or fixed, so that they have as many steps as samples",
                    &ShadowSettings::pattern)
                 .omitted_by_default()}};
}

Table<Model> shading() {
    return {{.name = "shading",
             .title = "[shading]",
             .meaning = "how normals are found; if omitted, Candela asks",
             .plugins = {{"model", PluginKind::shading, ""}}},
            {field(Type::text, "model", "default shading plugin; its parameters may follow", &Model::name)
                 .required()}};
}

Table<Model> reflection() {
    return {{.name = "reflection",
             .title = "[reflection]",
             .meaning = "how light is reflected; if omitted, Candela asks",
             .plugins = {{"model", PluginKind::reflection}}},
            {field(Type::text, "model", "default reflection plugin", &Model::name).required()}};
}

Table<LightSource> light() {
    return {
        {.name = "light",
         .title = "[[light]]",
         .meaning = "a light; any number",
         .plugins = {{"type", PluginKind::light, ""}}},
        {field(Type::text, "name", k_name, &LightSource::label, &Label::name).omitted_by_default(),
         field(Type::text, "type", "light plugin; its parameters follow", &LightSource::model, &Model::name)
             .required(),
         field(
             Type::real, "temperature",
             "colour temperature: the colour is multiplied by that of a black body, with the same luminance; "
             "0: it is not",
             &LightSource::temperature)
             .unit("K")
             .range(0, k_highest_temperature)
             .omitted_by_default(),
         field(Type::boolean, "casts_shadows", "whether objects block this light; only with [shadows]",
               &LightSource::casts_shadows)
             .omitted_by_default(),
         field(Type::integer, "ambient_occlusion_rays",
               "rays per point that find out how much of the light's ambient part is blocked; 0: none of "
               "it; only with [shadows]",
               &LightSource::ambient_occlusion, &AmbientOcclusion::rays)
             .range(0, 1024)
             .omitted_by_default(),
         field(Type::real, "ambient_occlusion_distance", "how near an object must be to block ambient light",
               &LightSource::ambient_occlusion, &AmbientOcclusion::distance)
             .unit("m")
             .above(0)
             .omitted_by_default(),
         field(Type::boolean, "background",
               "whether the light is seen where there is no object and in objects that mirror or refract; "
               "only lights that come from everywhere, such as environment and sky; replaces [image] "
               "background",
               &LightSource::is_background)
             .placed(&LightSource::background_place)
             .omitted_by_default()}};
}

Table<Object> object() {
    return {
        {.name = "object",
         .title = "[[object]]",
         .meaning = "an object; any number. [object.material] holds the parameters of its reflection model",
         .plugins = {{"type", PluginKind::shape, ""},
                     {"shading", PluginKind::shading},
                     {"reflection", PluginKind::reflection, "material"}},
         .tables = {normal_map_table().about(), bump_map_table().about()}},
        {field(Type::text, "name", k_name, &Object::label, &Label::name).omitted_by_default(),
         field(Type::text, "type", "shape plugin; its parameters follow", &Object::shape, &Model::name)
             .required(),
         field(Type::point, "position", "the position of the shape's origin", &Object::transform,
               &Transform::position)
             .unit("m")
             .placed(&Object::position_place),
         field(Type::vector, "rotation", "about x, then y, then z (fixed axes)", &Object::transform,
               &Transform::rotation)
             .unit("deg"),
         field(Type::rgb, "scale", "before rotation; one number or three", &Object::transform,
               &Transform::scale)
             .above(0),
         field(Type::color, "color", "colour of the surface; a texture may give it", &Object::color),
         field(Type::boolean, "encloses",
               "whether lights, the observer and other objects may be inside, as in a room or a lampshade; "
               "the object is then drawn from both sides",
               &Object::encloses),
         field(Type::boolean, "casts_shadows", "whether the object blocks light; only with [shadows]",
               &Object::casts_shadows)
             .omitted_by_default(),
         field(Type::boolean, "receives_shadows",
               "whether objects block the light on this one; only with [shadows]", &Object::receives_shadows)
             .omitted_by_default(),
         field(Type::boolean, "transmits_light",
               "whether light passes through the object if its reflection model is transparent: straight "
               "on, and coloured by it; otherwise it blocks light; only with [shadows]",
               &Object::transmits_light)
             .omitted_by_default(),
         field(Type::text, "shading", "shading plugin; overrides [shading]", &Object::shading, &Model::name),
         field(Type::text, "reflection", "reflection plugin; overrides [reflection]", &Object::reflection,
               &Model::name)}};
}

Table<CommonMaterial> material() {
    return {
        {.name = "material",
         .title = "[object.material]",
         .meaning = "keys of every material, next to the parameters of its reflection model; a parameter of "
                    "the same name takes the place of one"},
        {field(Type::color, "emission",
               "what the surface emits, added to the light that it reflects; it lights nothing else; a "
               "texture may give it",
               &CommonMaterial::emission)
             .omitted_by_default(),
         field(Type::real, "emission_strength", "multiplies the emission", &CommonMaterial::emission_strength)
             .minimum(0)
             .omitted_by_default(),
         field(Type::real, "occlusion",
               "the fraction of ambient light that reaches the surface, such as creases of a mesh; other "
               "light is not changed; a texture may give it",
               &CommonMaterial::occlusion)
             .range(0, 1)
             .omitted_by_default(),
         field(Type::real, "opacity",
               "the fraction of what is behind that the surface covers; below 1, the surface is drawn from "
               "both sides; a texture may give it, such as the alpha of a picture: channel = \"a\"; a list "
               "of textures or attributes is their product",
               &CommonMaterial::opacity)
             .range(0, 1)
             .omitted_by_default(),
         field(Type::real, "opacity_cutoff",
               "above 0: the surface is opaque where its opacity is at least this, and absent elsewhere",
               &CommonMaterial::opacity_cutoff)
             .range(0, 1)
             .omitted_by_default()}};
}

Table<Orbit> orbit() {
    return {{.name = "orbit",
             .title = "[animation.orbit]",
             .meaning = "moves the observer around its look-at point, about its 'up', back to the start "
                        "after the last frame; optional"},
            {field(Type::real, "turns",
                   "over all frames; counter-clockwise seen from above, clockwise if negative", &Orbit::turns)
                 .range(-1'000'000, 1'000'000)}};
}

Table<Track> track() {
    return {{.name = "track",
             .title = "[[animation.track]]",
             .meaning = "one value of the scene that changes over time; any number",
             .timed = {"keys"}},
            {field(Type::text, "path",
                   R"(what changes, as --set names it: "light.lamp.intensity", "object.0.rotation")",
                   &Track::path)
                 .required(),
             unheld<Track>(Type::numbers, "keys",
                           "seconds, strictly increasing, and the value at that time; constant before the "
                           "first key and after the last"),
             choice({"linear", "step", "smooth"}, "interpolation",
                    "between keys: in a straight line; not at all, until the next key; or along a "
                    "Catmull-Rom spline through all keys, which may exceed their values",
                    &Track::interpolation)}};
}

Table<Animation> animation() {
    return {{.name = "animation",
             .title = "[animation]",
             .meaning = "makes the scene a film; optional (docs/user/animation.md)",
             .tables = {orbit().about(), track().about()}},
            {field(Type::integer, "frames", "number of frames, numbered from 0", &Animation::frames)
                 .required()
                 .range(1, 1'000'000),
             field(Type::real, "fps", "frames per second: frame i is at i / fps seconds", &Animation::fps)
                 .above(0)
                 .maximum(1000)}};
}

}  // namespace

const OwnTables& own_tables() {
    static const OwnTables k_tables{.room = room(),
                                    .observer = observer(),
                                    .image = image(),
                                    .constraints = constraints(),
                                    .shadows = shadows(),
                                    .shading = shading(),
                                    .reflection = reflection(),
                                    .light = light(),
                                    .object = object(),
                                    .normal_map = normal_map_table(),
                                    .bump_map = bump_map_table(),
                                    .material = material(),
                                    .texture = texture_table(),
                                    .attribute = vertex_attribute_table(),
                                    .texture_transform = texture_transform_table(),
                                    .orbit = orbit(),
                                    .track = track(),
                                    .animation = animation()};
    return k_tables;
}

const TableSchema& top_schema() {
    static const TableSchema k_table{
        .title = "the top of the file",
        .meaning = "keys before all tables",
        .parameters = {{.name = "version",
                        .type = Type::integer,
                        .meaning =
                            "version of the scene file's format; required, exactly once across all files",
                        .choices = {"1"}},
                       {.name = "include",
                        .type = Type::file,
                        .meaning = "files to include; relative to this one, each at most once",
                        .default_value = std::string()}},
        .lists = {"include"}};
    return k_table;
}

std::span<const TableSchema> scene_schema() {
    static const OwnTables& own = own_tables();
    static const std::array k_tables = {
        own.room.about(),    own.observer.about(),  own.image.about(),      own.constraints.about(),
        own.shadows.about(), own.shading.about(),   own.reflection.about(), own.light.about(),
        own.object.about(),  own.animation.about(),
    };
    return k_tables;
}

const TableSchema& material_schema() { return own_tables().material.about(); }

const Parameter& material_parameter(std::string_view name) {
    return *std::ranges::find(material_schema().parameters, name, &Parameter::name);
}

const Parameter& color_parameter() {
    return *std::ranges::find(own_tables().object.about().parameters, "color", &Parameter::name);
}

bool takes_texture(const Parameter& of_material) {
    return of_material.name != "emission_strength" && of_material.name != "opacity_cutoff";
}

const TableSchema& texture_schema() { return own_tables().texture.about(); }
const TableSchema& vertex_attribute_schema() { return own_tables().attribute.about(); }

bool takes_texture(const Manifest& plugin, const Parameter& parameter) {
    return plugin.kind == PluginKind::reflection && plugin.surface_needs.varying &&
           (parameter.type == Type::real || parameter.type == Type::rgb || parameter.type == Type::color);
}

}  // namespace candela
