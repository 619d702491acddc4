#include "candela/target/glsl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "candela/embed.h"
#include "candela/kernel_language/lexer.h"
#include "candela/target/kernels.h"
#include "candela/target/mirror.h"
#include "candela/target/text_template.h"
#include "candela/target/textures.h"
#include "glsl_lights.h"
#include "glsl_materials.h"

CANDELA_EMBED(candela_target_trigonometry, CANDELA_TARGET_TEMPLATES "/trigonometry.glsl");
CANDELA_EMBED(candela_target_lit, CANDELA_TARGET_TEMPLATES "/lit.glsl");
CANDELA_EMBED(candela_target_vertex, CANDELA_TARGET_TEMPLATES "/vertex.glsl");
CANDELA_EMBED(candela_target_fragment, CANDELA_TARGET_TEMPLATES "/fragment.glsl");
CANDELA_EMBED(candela_target_triangle_vertex, CANDELA_TARGET_TEMPLATES "/triangle_vertex.glsl");
CANDELA_EMBED(candela_target_triangle_fragment, CANDELA_TARGET_TEMPLATES "/triangle_fragment.glsl");
CANDELA_EMBED(candela_target_texture_vertex, CANDELA_TARGET_TEMPLATES "/texture_vertex.glsl");
CANDELA_EMBED(candela_target_texture_fragment, CANDELA_TARGET_TEMPLATES "/texture_fragment.glsl");
CANDELA_EMBED(candela_target_channels_vertex, CANDELA_TARGET_TEMPLATES "/channels_vertex.glsl");
CANDELA_EMBED(candela_target_channels_fragment, CANDELA_TARGET_TEMPLATES "/channels_fragment.glsl");
CANDELA_EMBED(candela_target_shadow_fragment, CANDELA_TARGET_TEMPLATES "/shadow_fragment.glsl");
CANDELA_EMBED(candela_target_opacity_vertex, CANDELA_TARGET_TEMPLATES "/opacity_vertex.glsl");
CANDELA_EMBED(candela_target_opacity_fragment, CANDELA_TARGET_TEMPLATES "/opacity_fragment.glsl");
CANDELA_EMBED(candela_target_layer_uniforms, CANDELA_TARGET_TEMPLATES "/layer_uniforms.glsl");
CANDELA_EMBED(candela_target_cover, CANDELA_TARGET_TEMPLATES "/cover.glsl");
CANDELA_EMBED(candela_target_screen, CANDELA_TARGET_TEMPLATES "/screen.glsl");
CANDELA_EMBED(candela_target_accumulate, CANDELA_TARGET_TEMPLATES "/accumulate.glsl");
CANDELA_EMBED(candela_target_encode, CANDELA_TARGET_TEMPLATES "/encode.glsl");

namespace candela::target {

namespace {

constexpr const char* k_preamble =
    "#define KERNEL\n"
    "// GLSL leaves the result for the zero vector undefined; here it stays zero.\n"
    "vec2 unit_or_zero(vec2 v) { return v * inversesqrt(max(dot(v, v), 1.0e-36)); }\n"
    "vec3 unit_or_zero(vec3 v) { return v * inversesqrt(max(dot(v, v), 1.0e-36)); }\n"
    "vec4 unit_or_zero(vec4 v) { return v * inversesqrt(max(dot(v, v), 1.0e-36)); }\n"
    "#define normalize unit_or_zero\n\n";

std::string uniform_of(const ExportedModel& model, const char* name) {
    return has_parameters(model) ? fmt::format("uniform {} {};\n", model.plugin->kernel.parameters, name)
                                 : "";
}

/// Values derived from the parameters are computed once for each vertex or pixel, before the loop over its
/// lights. `parameters`: the variable that has them.
std::string preparation_of(const ExportedModel& model, const char* name, const char* macro,
                           const char* parameters) {
    if (!has_function(model, "prepare")) return "";
    return fmt::format(
        "{0} {1}_constants;\nvoid prepare_{1}() {{ {1}_constants = {2}; }}\n#define PREPARED_{3}\n",
        constants_type(model), name, prepared(model, parameters), macro);
}

/// For programs in which not every model has a preparation.
std::string calls_of_preparations(const ExportedScene& scene) {
    const auto call_of = [](const auto& models, const char* name, const char* macro) {
        const bool is_there = std::ranges::any_of(
            models, [](const ExportedModel& model) { return has_function(model, "prepare"); });
        return is_there ? fmt::format("#ifdef PREPARED_{}\n    prepare_{}();\n#endif\n", macro, name)
                        : std::string();
    };
    return call_of(scene.shadings, "shading", "SHADING") + call_of(scene.reflections, "material", "MATERIAL");
}

std::string constants_name(const ExportedModel& model, const std::string& name,
                           const std::string& parameters) {
    return has_function(model, "prepare") ? name + "_constants" : parameters;
}

std::string needs_text(const ExportedReflection& model) {
    return std::string(model.needs.tangent ? "#define NEEDS_TANGENT\n" : "") +
           (model.needs.position ? "#define NEEDS_POSITION\n" : "") +
           (model.needs.uv ? "#define NEEDS_UV\n" : "");
}

/// Some models wrap light around a surface, so that it also counts where N.L <= 0.
std::string horizon_text(const ExportedReflection& model) {
    const bool is_below = std::ranges::any_of(model.plugin->properties, [](const Property& property) {
        return std::string_view(property.name) == "lights-below-horizon";
    });
    return fmt::format("bool lights_below_horizon() {{ return {}; }}\n", is_below);
}

/// Textures may give numbers of the material at a point.
std::string own_material(const ExportedReflection& model, bool has_common) {
    const bool has_own = has_parameters(model);
    std::string text = has_own
                           ? fmt::format(
                                 "#ifdef TEXTURED_MATERIAL\n{} own_material;\n#else\n#define own_material "
                                 "material\n#endif\n",
                                 model.plugin->kernel.parameters)
                           : "";
    if (has_common)
        text += fmt::format("#ifdef TEXTURED_MATERIAL\nvoid start_material() {{{}}}\n#endif\n",
                            has_own ? " own_material = material; " : "");
    return text;
}

/// 0 for a model that does not say how wide its highlight is.
std::string width_text(const ExportedReflection& model, const char* material) {
    return fmt::format("float highlight_width() {{ return {}; }}\n",
                       model.is_glossy ? fmt::format("clamp({}, 1.0e-4, 1.0)",
                                                     call(model, "highlight_width",
                                                          constants_name(model, "material", material), ""))
                                       : "0.0");
}

std::string reflection_text(const ExportedReflection& model, const ExportedScene& scene, bool is_textured,
                            bool has_common) {
    const char* const material = is_textured ? "own_material" : "material";
    return fmt::format(
        "{}\n{}{}{}{}{}{}Reflected reflect_light(Surface s, vec3 to_light) {{ return {}; }}\n"
        "vec3 reflect_ambient(Surface s) {{ return {}; }}\n",
        model.plugin->kernel.text, uniform_of(model, "material"),
        is_textured ? own_material(model, has_common) : "",
        preparation_of(model, "material", "MATERIAL", material), needs_text(model),
        scene.has_shadows ? horizon_text(model) : "",
        has_mirror_images(scene) ? width_text(model, material) : "",
        call(model, "reflect", constants_name(model, "material", material), "s, to_light"),
        call(model, "reflect_ambient", constants_name(model, "material", material), "s"));
}

std::string shading_text(const ExportedShading& model, const ExportedScene& scene) {
    constexpr const char* k_rates[] = {"#define INTENSITY_RATE flat\n",
                                       "#define INTENSITY_RATE\n#define LIT_AT_VERTEX\n",
                                       "#define LIT_AT_FRAGMENT\n"};
    const char* const triangle =
        model.needs.triangle ? "#define NEEDS_TRIANGLE\nTriangle seen_triangle;\n" : "";
    const bool is_face = model.rate == ShadingRate::face && has_textured_opacity(scene);
    return fmt::format(
        "{}\n{}{}{}{}{}vec3 shading_normal(ShadingPoint p) {{ return {}; }}\n", model.plugin->kernel.text,
        uniform_of(model, "shading"), preparation_of(model, "shading", "SHADING", "shading"),
        k_rates[static_cast<int>(model.rate)], is_face ? "#define LIT_AT_FACE\n" : "", triangle,
        call(model, "normal", constants_name(model, "shading", "shading"),
             model.needs.triangle ? "p, seen_triangle" : "p"));
}

/// A part that a stage's shaders have only in programs of scenes that need it.
struct Feature {
    bool is_there = false;
    const char* declarations = "";
    const char* place = "";  // after `statement`, in the stage's text
    const char* condition = "";
    const char* statement = "";
};

/// Sets what textures are looked up by, and finds the numbers that they give.
std::string look_up_text(const ExportedScene& scene, const char* place, const char* prefix) {
    std::string text;
    if (!scene.textures.empty())
        text += fmt::format("#ifdef READS_PICTURES\n{}    lit_uv = {}uv;\n#endif\n", place, prefix);
    if (needs_channels(scene))
        text += fmt::format(
            "#ifdef READS_CHANNELS\n    lit_channels_0 = {0}channels_0;\n    lit_channels_1 = "
            "{0}channels_1;\n#endif\n",
            prefix);
    if (!text.empty()) text += "#ifdef TEXTURED_MATERIAL\n    find_material();\n#endif\n";
    return text;
}

/// The numbers of the vertices that an opacity reads go to the fragments where light is not evaluated there.
struct OpacityTexts {
    std::string pass, receive, find;  // of the vertex shader, of the fragment shader, and in its main()
};
OpacityTexts opacity_texts(const ExportedScene& scene) {
    if (!has_textured_opacity(scene)) return {};
    const auto if_channels = [&](std::string_view text) {
        return has_opacity_of_channels(scene) ? fmt::format("#ifdef OPACITY_READS_CHANNELS\n{}#endif\n", text)
                                              : std::string();
    };
    return {.pass = filled(
                candela_target_opacity_vertex,
                {{"CHANNELS_OUT", if_channels("out vec2 seen_channels;\n")},
                 {"PASS_CHANNELS", if_channels("    at_channel_edges = channel_edges;\n"
                                               "    lit_channels_0 = channels_0;\n"
                                               "    lit_channels_1 = channels_1;\n"
                                               "    seen_channels = numbers_of_corner(opacity_channels(), "
                                               "channel_edges);\n")}}),
            .receive = filled(candela_target_opacity_fragment,
                              {{"CHANNELS_IN", if_channels("in vec2 seen_channels;\n")}}),
            .find =
                "#ifdef OPACITY_AT_FRAGMENT\n#ifdef READS_PICTURES\n    lit_place = seen_place;\n"
                "    lit_uv = seen_uv;\n#endif\n" +
                if_channels("    set_opacity_channels(seen_channels);\n") +
                "#endif\n#ifdef TEXTURED_OPACITY\n    opacity = textured_opacity();\n#endif\n"};
}
constexpr const char* k_seen_side =
    "    seen_side = facing * point.face_normal;\n    seen_facing = facing;\n"
    "#ifdef LIT_AT_VERTEX\n"
    "    vec3 to_middle = normalize(object_middle - place);\n"
    "    seen_inward = 2.0 * (to_middle - seen_side * dot(seen_side, to_middle));\n"
    "#endif\n";
constexpr const char* k_shading_normal = "    s.normal = facing * shading_normal(point);\n";
constexpr const char* k_mapped_normal =
    "#if defined(NORMAL_MAPPED) && defined(LIT_AT_FRAGMENT)\n"
    "    s.normal = facing * mapped_normal(shading_normal(point), point);\n#else\n"
    "    s.normal = facing * shading_normal(point);\n#endif\n";

std::string stage_text(const char* text, const std::vector<Feature>& features, Values values = {}) {
    std::string declarations;
    for (const Feature& f : features) {
        if (f.is_there) declarations += f.declarations;
        if (*f.place == '\0') continue;
        values.emplace_back(
            f.place, f.is_there ? fmt::format("#if {}\n    {}\n#endif\n", f.condition, f.statement) : "");
    }
    return declarations + filled(text, views_of(values));
}

/// Vertices have sixteen attributes.
void require_room_for_channels(const ExportedScene& scene) {
    constexpr std::size_t k_most_channels = 8;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const std::size_t count = scene.geometry->in_world_space(i).channels.size();
        if (count > k_most_channels)
            throw std::runtime_error(
                fmt::format("object {} takes {} numbers from its vertices; shaders have room for {}",
                            scene.objects[i].label, count, k_most_channels));
    }
    for (const ExportedShading& model : scene.shadings)
        if (model.needs.triangle)
            throw std::runtime_error(
                fmt::format("shading model '{}' reads its triangle, which leaves no room for numbers of the "
                            "vertices in shaders",
                            model.plugin->name));
}

bool has_trigonometry(const std::string& code) {
    constexpr std::array<std::string_view, 4> k_functions = {"sin", "cos", "asin", "acos"};
    const auto tokens = kernel_language::code_of(code);
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        if (std::ranges::find(k_functions, tokens[i].text) != k_functions.end() &&
            kernel_language::text_at(tokens, i + 1) == "(")
            return true;
    }
    return false;
}

}  // namespace

const GlslDepth k_reversed_depth{
    .uniform = "uniform float near;\n",
    .statement =
        "    // Depths grow towards the eye; in perspective they are near / distance, which a float buffer "
        "holds with the same relative precision\n    // at all distances.\n"
        "    gl_FragDepth = is_orthographic ? 1.0 - gl_FragCoord.z : near * gl_FragCoord.w;\n",
    .not_behind = ">="};

GlslParts glsl_of(const ExportedScene& scene, const GlslDepth& depth, NormalScale normal_scale) {
    require_different_names(scene);
    const bool is_textured = !scene.textures.empty();
    GlslParts parts;
    const auto if_shadows = [&](const char* text) { return scene.has_shadows ? text : ""; };
    const bool has_layers = has_opacity(scene);
    const OpacityTexts opacity = opacity_texts(scene);
    const std::string layer_inputs = opacity.receive + (has_layers ? candela_target_layer_uniforms : "");
    const std::string cover =
        filled(candela_target_cover, {{"FIND_OPACITY", opacity.find}, {"NOT_BEHIND", depth.not_behind}});
    const std::string lit =
        filled(candela_target_lit, {{"PREPARATION", calls_of_preparations(scene)},
                                    {"NORMAL", has_normal_maps(scene) ? k_mapped_normal : k_shading_normal},
                                    {"COLOR", has_color_textures(scene) ? "own_color" : "object_color"},
                                    {"EMISSION", has_emission(scene) ? " + own_emission" : ""},
                                    {"SEEN_SIDE", if_shadows(k_seen_side)}});
    parts.lights = common_material(scene) + lights_text(scene);
    for (const auto& model : scene.reflections)
        parts.reflections.push_back(
            reflection_text(model, scene, has_textured_materials(scene), has_common_textures(scene)));
    for (const auto& model : scene.shadings) parts.shadings.push_back(shading_text(model, scene));
    const bool needs_triangle = sees_triangles(scene);
    const bool has_channels = needs_channels(scene);
    if (has_channels) require_room_for_channels(scene);
    constexpr const char *k_triangle = "defined(NEEDS_TRIANGLE)", *k_texture = "defined(TEXTURED)",
                         *k_opacity = "defined(OPACITY_AT_FRAGMENT)",
                         *k_channels = "defined(READS_CHANNELS) && defined(LIT_AT_FRAGMENT)";
    parts.vertex =
        lit +
        stage_text(
            candela_target_vertex,
            {{needs_triangle, candela_target_triangle_vertex, "PASS_TRIANGLE", k_triangle,
              "pass_triangle();"},
             {is_textured, candela_target_texture_vertex, "PASS_TEXTURE", k_texture, "pass_texture();"},
             {has_channels, candela_target_channels_vertex, "PASS_CHANNELS", k_channels, "pass_channels();"},
             {has_textured_opacity(scene), opacity.pass.c_str(), "PASS_OPACITY", k_opacity,
              "pass_opacity(position, uv);"}},
            {{"MATERIAL", look_up_text(scene, "", "")},
             {"CORNER", if_shadows("flat out vec3 at_corner;\n")},
             {"PASS_CORNER", if_shadows("    at_corner = position;\n")}});
    parts.fragment =
        lit + stage_text(candela_target_fragment,
                         {{needs_triangle, candela_target_triangle_fragment, "READ_TRIANGLE", k_triangle,
                           "read_triangle();"},
                          {is_textured, candela_target_texture_fragment},
                          {has_channels, candela_target_channels_fragment}},
                         {{"MATERIAL", look_up_text(scene, "    lit_place = at_place;\n", "at_")},
                          {"DEPTH_UNIFORM", depth.uniform},
                          {"DEPTH", depth.statement},
                          {"SHADOW_PLACE", if_shadows(candela_target_shadow_fragment)},
                          {"LAYER_UNIFORMS", layer_inputs},
                          {"COVER", has_layers ? cover : ""},
                          {"PLACE", scene.has_shadows ? "place_on_triangle()" : "at_place"}});
    if (is_textured) {
        parts.texture = "#define TEXTURED\n" + texture_functions(scene, material_units(scene));
        if (has_normal_maps(scene)) parts.texture += std::string(normal_map_kernel()) + "\n";
    }
    parts.materials = textured_materials(scene);
    parts.normal_maps = normal_map_texts(scene, normal_scale);
    parts.opacities = textured_opacities(scene);
    parts.common_materials = textured_common_materials(scene);
    parts.screen = candela_target_screen;
    parts.accumulate = candela_target_accumulate;
    parts.encode = "#define KERNEL\n" + std::string(tone_kernel()) + "\n" + candela_target_encode;

    std::string users = parts.lights + parts.vertex + parts.fragment;
    for (const auto* texts : {&parts.reflections, &parts.shadings}) {
        for (const std::string& text : *texts) users += text;
    }
    parts.prelude = k_preamble;
    if (has_trigonometry(users)) parts.prelude += candela_target_trigonometry;
    parts.prelude += needed_parts(glsl_tables(), users);
    parts.prelude += needed_parts(kernel_prelude(), users) + "\n";
    return parts;
}

std::string whole_glsl_prelude() {
    return without_comments(std::string(k_preamble) + candela_target_trigonometry +
                            std::string(glsl_tables()) + std::string(kernel_prelude()) + "\n");
}

bool sees_triangles(const ExportedScene& scene) {
    return std::ranges::any_of(scene.shadings, [](const auto& model) { return model.needs.triangle; });
}

const char* rate_name(ShadingRate rate) {
    constexpr const char* k_names[] = {"face", "vertex", "fragment"};
    return k_names[static_cast<int>(rate)];
}

}  // namespace candela::target
