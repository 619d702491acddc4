// The tables of pictures and of vertices' attributes, which an object and its material may hold.
module;

#include <string>
#include <utility>
#include <vector>

module candela.scene;

import :fields;
import candela.api;

namespace candela {

namespace {

using Type = ParamType;

Field<NormalMap> picture_of_normals(const char* meaning) {
    return field(Type::file, "texture", meaning, &NormalMap::file).required().placed(&NormalMap::place);
}

/// Whether a picture may be repeated in a mirror: one of heights would need other slopes there.
enum class Mirroring : bool { no, yes };

/// The keys of a picture that place it on a surface.
template <class T>
std::vector<Field<T>> placing(Mirroring mirroring) {
    std::vector<std::string> wraps = {"repeat", "clamp"}, of_v = {"same", "repeat", "clamp"};
    const char* meaning = "beyond the picture's edges: repeat it, or continue the values at its edges";
    if (mirroring == Mirroring::yes) {
        wraps.emplace_back("mirror");
        of_v.emplace_back("mirror");
        meaning =
            "beyond the picture's edges: repeat it, continue the values at its edges, or repeat it, "
            "reversed every other time";
    }
    return {choice(wraps, "wrap", meaning, &T::placing, &TexturePlacing::wrap).omitted_by_default(),
            choice(of_v, "wrap_v", "beyond the picture's upper and lower edges; same: as wrap says",
                   &T::placing, &TexturePlacing::wrap_v)
                .omitted_by_default(),
            field(Type::integer, "uv", "the set of texture coordinates; 1: the second one of a glTF file",
                  &T::placing, &TexturePlacing::uv)
                .range(0, 1)
                .omitted_by_default()};
}

template <class T>
std::vector<Field<T>> with_placing(std::vector<Field<T>> fields, Mirroring mirroring = Mirroring::yes) {
    for (Field<T>& field : placing<T>(mirroring)) fields.push_back(std::move(field));
    return fields;
}

std::vector<Field<ParameterTexture>> values_of_texture(const char* channel, const char* scale,
                                                       const char* offset) {
    return {choice({"rgb", "r", "g", "b", "a"}, "channel", channel, &ParameterTexture::channel)
                .omitted_by_default(),
            field(Type::rgb, "scale", scale, &ParameterTexture::scale).omitted_by_default(),
            field(Type::rgb, "offset", offset, &ParameterTexture::offset).omitted_by_default()};
}

}  // namespace

Table<TextureTransform> texture_transform_table() {
    return {
        {.name = "transform",
         .title = "transform",
         .meaning = "how the picture is placed on the texture coordinates: they are scaled, rotated, then "
                    "moved; optional"},
        {pair("scale", "along u and v: 2 repeats the picture twice", &TextureTransform::scale)
             .omitted_by_default(),
         field(Type::real, "rotation", "counter-clockwise about (0, 0)", &TextureTransform::rotation)
             .unit("deg")
             .omitted_by_default(),
         pair("offset", "added along u and v", &TextureTransform::offset).omitted_by_default()}};
}

Table<NormalMap> normal_map_table() {
    return {{.name = "normal_map",
             .title = "normal_map",
             .meaning = "a picture of normals, 2 * texel - 1 each, which tilt those of a shading model that "
                        "evaluates light per fragment; optional",
             .tables = {texture_transform_table().about()}},
            with_placing<NormalMap>(
                {picture_of_normals("red: along u, green: along v, blue: along the surface's normal"),
                 field(Type::real, "scale", "multiplies the normals' parts along u and v", &NormalMap::scale)
                     .omitted_by_default()})};
}

Table<NormalMap> bump_map_table() {
    return {{.name = "bump_map",
             .title = "bump_map",
             .meaning = "a picture of heights above the surface, whose slopes tilt the normals of a shading "
                        "model that evaluates light per fragment; optional, instead of normal_map",
             .tables = {texture_transform_table().about()}},
            with_placing<NormalMap>(
                {picture_of_normals("its red channel has the heights"),
                 field(Type::real, "height", "of white above black", &NormalMap::scale).unit("m").required()},
                Mirroring::no)};
}

Table<ParameterTexture> texture_table() {
    std::vector<Field<ParameterTexture>> fields = {
        field(Type::file, "texture", "the picture, placed by the shape's texture coordinates",
              &ParameterTexture::file)
            .required()
            .placed(&ParameterTexture::place)};
    for (auto& value : values_of_texture(
             "what the parameter takes: all channels, or one, where a is the opacity of the picture's "
             "pixels; a parameter with one number takes the red one unless told",
             "multiplies the picture; one number or three", "added to the picture; one number or three"))
        fields.push_back(std::move(value));
    fields = with_placing(std::move(fields));
    fields.push_back(
        choice({"auto", "linear", "srgb"}, "encoding",
               "what its numbers mean: linear values, or sRGB like those of a photograph; auto: sRGB "
               "where a parameter takes three channels, linear where it takes one",
               &ParameterTexture::encoding)
            .omitted_by_default());
    return {{.name = "texture",
             .title = "a texture",
             .meaning =
                 "a picture from which an object's colour, or a parameter of its material, takes its value "
                 "at each point: offset + scale * texel, within the parameter's range",
             .tables = {texture_transform_table().about()}},
            std::move(fields)};
}

Table<ParameterTexture> vertex_attribute_table() {
    std::vector<Field<ParameterTexture>> fields = {
        field(Type::text, "attribute",
              "its name in the mesh file, such as _wear in glTF or wear in PLY; color: the vertex colours",
              &ParameterTexture::attribute)
            .required()
            .placed(&ParameterTexture::place)};
    for (auto& value : values_of_texture(
             "which of its numbers the parameter takes: the first three, or one; a parameter with one "
             "number takes the first unless told",
             "multiplies the attribute; one number or three", "added to it; one number or three"))
        fields.push_back(std::move(value));
    return {{.name = "attribute",
             .title = "a vertex attribute",
             .meaning = "numbers of a mesh's vertices from which an object's colour, or a parameter of its "
                        "material, takes its value: offset + scale * attribute, interpolated over "
                        "triangles, within the parameter's range"},
            std::move(fields)};
}

}  // namespace candela
