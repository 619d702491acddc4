#include "textures.h"

#include <fmt/format.h>

#include <cstddef>

#include "candela/embed.h"
#include "candela/target/text_template.h"
#include "candela/target/textures.h"

CANDELA_EMBED(candela_cpp_textures, CANDELA_SOURCE_DIR "/templates/textures.h");
CANDELA_EMBED(candela_cpp_texture_seen, CANDELA_SOURCE_DIR "/templates/texture_seen.h");
CANDELA_EMBED(candela_cpp_placed_texture, CANDELA_SOURCE_DIR "/templates/placed_texture.h");
CANDELA_EMBED(candela_cpp_normal_maps, CANDELA_SOURCE_DIR "/templates/normal_maps.h");
CANDELA_EMBED(candela_cpp_normal_texel, CANDELA_SOURCE_DIR "/templates/normal_texel.h");
CANDELA_EMBED(candela_cpp_textured_material, CANDELA_SOURCE_DIR "/templates/textured_material.h");

namespace candela::cpp_target {

using namespace target;

namespace {

constexpr const char* k_placing =
    "// How a texture is placed: u' = m[0] u + m[1] v + m[2], v' with the other three.\n"
    "using Placing = std::array<float, 6>;\n\n";
constexpr const char* k_number_of =
    "float number_of(float texel, float scale, float offset, float low, float high) { return "
    "std::min(std::max(offset + scale * texel, low), high); }\n\n";

}  // namespace

TextureTexts textures_of(const ExportedScene& scene, const std::string& textured_materials) {
    if (scene.textures.empty()) return {};
    std::string images;
    for (std::size_t i = 0; i < scene.textures.size(); ++i) {
        images += fmt::format(
            "const std::vector<TextureLevel>& texture_{}() {{  // {}\n"
            "    static const std::vector<TextureLevel> levels = texture_levels(\"{}\");\n"
            "    return levels;\n}}\n\n",
            i, title_of(scene.textures[i]), texture_file(i));
    }
    const bool has_materials = !textured_materials.empty(), has_normals = has_normal_maps(scene),
               has_opacities = has_textured_opacity(scene);
    const std::string seen = filled(candela_cpp_texture_seen,
                                    {{"IS_SEEN_PARAMETER", has_opacities ? ", bool is_seen = false" : ""},
                                     {"IS_SEEN", has_opacities ? "is_seen || " : ""}});
    return {filled(candela_cpp_textures, {{"FILE", std::string(texture_file_source())},
                                          {"KERNEL", std::string(texture_kernel())},
                                          {"PICTURES", images}}) +
                k_placing +
                (has_normals ? filled(candela_cpp_normal_maps, {{"KERNEL", std::string(normal_map_kernel())}})
                             : std::string()),
            seen + candela_cpp_placed_texture + (has_materials || has_opacities ? k_number_of : "") +
                (has_normals ? candela_cpp_normal_texel : "") +
                (has_materials ? filled(candela_cpp_textured_material, {{"CASES", textured_materials}})
                               : std::string())};
}

const char* readme_of_textures() {
    return "The pictures of textures are PPM files next to `scene.cpp`, which many programs show and edit: "
           "with 8 bits per channel for colours, with 16\nfor intensities. They must stay in the folder of "
           "`scene.cpp` or of the program.\n\n";
}

}  // namespace candela::cpp_target
