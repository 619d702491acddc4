#include "opacity.h"

#include "candela/embed.h"
#include "candela/target/textures.h"

CANDELA_EMBED(candela_cpp_draw_sample, CANDELA_SOURCE_DIR "/templates/draw_sample.h");
CANDELA_EMBED(candela_cpp_draw_layers, CANDELA_SOURCE_DIR "/templates/draw_layers.h");
CANDELA_EMBED(candela_cpp_opacity, CANDELA_SOURCE_DIR "/templates/opacity.h");
CANDELA_EMBED(candela_cpp_light_passes, CANDELA_SOURCE_DIR "/templates/light_passes.h");

namespace candela::cpp_target {

using namespace target;

namespace {

constexpr const char* k_members =
    "    float opacity = 1.0f;         // the fraction of what is behind that it covers\n"
    "    float opacity_cutoff = 0.0f;  // above 0: it is opaque from this opacity on, and absent elsewhere\n";
constexpr const char* k_texture_member =
    "    int textured_opacity = -1;    // its number in opacity_at(), if a texture gives its opacity\n";

constexpr const char* k_opacity_place =
    "// Rays of shadows read the finest texels.\n"
    "TexturePlace opacity_place(const Object& o, int triangle, vec3 b, bool is_seen) {\n"
    "    TexturePlace at = place_within(o, triangle, b, is_seen);\n"
    "    at.is_pixel = is_seen;\n"
    "    return at;\n"
    "}\n\n";

constexpr const char* k_is_behind =
    "float opacity_at(const Object& o, int triangle, vec3 b, bool is_seen);\n\n"
    "// Surfaces that are equally near come in the order of the scene.\n"
    "bool is_behind(double nearness, int object, int triangle, const Seen& before) {\n"
    "    if (nearness != before.nearness) return nearness < before.nearness;\n"
    "    return object != before.object ? object > before.object : triangle > before.triangle;\n"
    "}\n\n";

constexpr const char* k_skip_before =
    "            if (!is_behind(-distance, object, triangle, before[static_cast<std::size_t>(y) * k_width + "
    "static_cast<std::size_t>(x)])) continue;\n";

constexpr const char* k_crossing_struct =
    "struct Crossing {  // of a ray and a surface that blocks only a part of the light\n"
    "    const Object* object;\n"
    "    int triangle;\n"
    "    double distance;\n"
    "    vec3 weights;  // of the triangle's corners\n"
    "};\n\n";

std::string let_pass(const ExportedScene& scene) {
    return std::string("    if (!is_met || (blocker.object->opacity >= 1") +
           (has_textured_opacity(scene) ? " && blocker.object->textured_opacity < 0" : "") +
           ")) return is_met;\n"
           "    const auto weight = [&](double part) { return static_cast<float>(part / area); };\n"
           "    ray.crossings->push_back({blocker.object, blocker.triangle, distance, vec3(weight(a), "
           "weight(b), weight(c))});\n"
           "    return false;\n";
}

}  // namespace

Values opacity_texts(const ExportedScene& scene, const Values& shadows, const std::string& cases) {
    const bool is_there = has_opacity(scene), is_textured = has_textured_opacity(scene);
    const auto if_there = [&](const char* text) { return std::string(is_there ? text : ""); };
    const std::string opacity =
        is_there ? (is_textured ? k_opacity_place : "") +
                       filled(candela_cpp_opacity, {{"TRIANGLE", is_textured ? " triangle" : ""},
                                                    {"B", is_textured ? " b" : ""},
                                                    {"IS_SEEN", is_textured ? " is_seen" : ""},
                                                    {"OPACITY", is_textured ? "float" : "const float"},
                                                    {"CASES", cases}})
                 : "";
    return {{"OPACITY_MEMBERS", if_there(k_members) + (is_textured ? k_texture_member : "")},
            {"BEHIND_FUNCTION", if_there(k_is_behind)},
            {"BEHIND_PARAMETER", if_there(", const std::vector<Seen>& before")},
            {"SKIP_BEFORE", if_there(k_skip_before)},
            {"OPACITY", opacity},
            {"DRAW_SAMPLE",
             filled(is_there ? candela_cpp_draw_layers : candela_cpp_draw_sample, views_of(shadows))}};
}

Values opacity_of_shadows(const ExportedScene& scene) {
    const bool is_there = has_opacity(scene);
    const auto if_there = [&](const char* text, const char* otherwise = "") {
        return std::string(is_there ? text : otherwise);
    };
    return {{"CROSSING_STRUCT", if_there(k_crossing_struct)},
            {"CROSSINGS_MEMBER", if_there("    std::vector<Crossing>* crossings;\n")},
            {"BLOCKER_TRIANGLE", if_there("    int triangle;  // of the object\n")},
            {"BLOCKS", if_there("const bool is_met = ", "return ")},
            {"LET_PASS", is_there ? let_pass(scene) : ""},
            {"TRIANGLE_NUMBER", if_there(", static_cast<int>(c / 3)")},
            {"PASSING", if_there(candela_cpp_light_passes)},
            {"ZERO_OR_ONE", if_there("", ": 0 or 1")},
            {"CROSSINGS", if_there("    std::vector<Crossing> crossings;\n")},
            {"CROSSINGS_ARGUMENT", if_there(", &crossings")},
            {"IF_FREE", if_there("passing(crossings)", "1.0f")}};
}

}  // namespace candela::cpp_target
