#include "candela/target/glsl.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "candela/embed.h"
#include "candela/kernel_language/lexer.h"
#include "candela/target/kernels.h"
#include "candela/target/text_template.h"
#include "candela/target/textures.h"

CANDELA_EMBED(candela_target_trigonometry, CANDELA_TARGET_TEMPLATES "/trigonometry.glsl");
CANDELA_EMBED(candela_target_lit, CANDELA_TARGET_TEMPLATES "/lit.glsl");
CANDELA_EMBED(candela_target_vertex, CANDELA_TARGET_TEMPLATES "/vertex.glsl");
CANDELA_EMBED(candela_target_fragment, CANDELA_TARGET_TEMPLATES "/fragment.glsl");
CANDELA_EMBED(candela_target_triangle_vertex, CANDELA_TARGET_TEMPLATES "/triangle_vertex.glsl");
CANDELA_EMBED(candela_target_triangle_fragment, CANDELA_TARGET_TEMPLATES "/triangle_fragment.glsl");
CANDELA_EMBED(candela_target_texture, CANDELA_TARGET_TEMPLATES "/texture.glsl");
CANDELA_EMBED(candela_target_texture_vertex, CANDELA_TARGET_TEMPLATES "/texture_vertex.glsl");
CANDELA_EMBED(candela_target_texture_fragment, CANDELA_TARGET_TEMPLATES "/texture_fragment.glsl");
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

/// "point_light": the prefix of all names related to a model's lights.
std::string light_name(const ExportedModel& model) {
    return fmt::format("{}_light", model.plugin->kernel.prefix);
}

constexpr const char* k_light_table =
    "// The members of the lights' structs, one per texel and {0} in a row: as bits, so that a texel can be "
    "a vector, a\n"
    "// number or an integer. A texture has room for any number of lights, uniform variables for a few "
    "hundred.\n"
    "uniform highp isampler2D light_table;\n"
    "ivec3 table_bits(int at) {{ return texelFetch(light_table, ivec2(at % {0}, at / {0}), 0).xyz; }}\n"
    "vec3 table_vec3(int at) {{ return intBitsToFloat(table_bits(at)); }}\n"
    "float table_float(int at) {{ return intBitsToFloat(table_bits(at).x); }}\n"
    "int table_int(int at) {{ return table_bits(at).x; }}\n\n";

/// How a shader reads a member of a struct from the texels starting at `at`.
std::string read_member(ParamType type, std::size_t offset) {
    const auto read = [&](const char* reader, std::size_t beyond = 0) {
        const std::size_t texel = offset + beyond;
        return texel == 0 ? fmt::format("{}(at)", reader) : fmt::format("{}(at + {})", reader, texel);
    };
    switch (type) {
        case ParamType::real:
            return read("table_float");
        case ParamType::integer:
        case ParamType::boolean:
        case ParamType::choice:
            return read("table_int");
        case ParamType::matrix:
            return fmt::format("mat3({}, {}, {})", read("table_vec3"), read("table_vec3", 1),
                               read("table_vec3", 2));
        case ParamType::file:
        case ParamType::numbers:
            return fmt::format("Table({0}.x, {0}.y)", read("table_bits"));
        default:
            return read("table_vec3");
    }
}

/// A light model's lights: how to read one, and the loop that adds them up.
struct LightLoop {
    std::string declarations;
    std::string statements;
};

LightLoop loop_over(const ExportedModel& model, const LightBlock& block) {
    const PluginDescriptor& plugin = *model.plugin;
    LightLoop loop;
    loop.declarations = fmt::format("uniform int {};\n", block.count);
    std::string body;
    if (has_parameters(model)) {
        std::vector<std::string> members;
        std::size_t offset = 0;
        for (const std::size_t i : plugin.kernel.members) {
            members.push_back(read_member(plugin.parameters[i].type, offset));
            offset += texels_of(plugin.parameters[i].type);
        }
        const std::string type = plugin.kernel.parameters, read = "read_" + light_name(model);
        loop.declarations += fmt::format(
            "{0} {1}(int i) {{\n    int at = {2}{3} * i;\n    return {0}({4});\n}}\n", type, read,
            block.first == 0 ? "" : fmt::format("{} + ", block.first), block.size, fmt::join(members, ", "));
        body = fmt::format("        {} light = {};\n", constants_type(model), prepared(model, read + "(i)"));
    }
    constexpr const char* k_sum =
        "{0}Reflected reflected = reflect_light(s, incident.to_light);\n"
        "{0}sum += reflected.diffuse * incident.diffuse + reflected.specular * incident.specular;\n";
    if (has_function(model, "sample_count")) {
        body += fmt::format(
            "        int samples = {};\n        for (int k = 0; k < samples; ++k) {{\n"
            "            Incident incident = {};\n",
            call(model, "sample_count", "light", ""), call(model, "illuminate", "light", "r, k"));
        body += fmt::format(fmt::runtime(k_sum), "            ") + "        }\n";
    } else if (has_function(model, "illuminate")) {
        body += fmt::format("        Incident incident = {};\n", call(model, "illuminate", "light", "r"));
        body += fmt::format(fmt::runtime(k_sum), "        ");
    }
    if (has_function(model, "illuminate_ambient"))
        body += fmt::format("        sum += reflect_ambient(s) * {};\n",
                            call(model, "illuminate_ambient", "light", "r"));
    loop.statements = fmt::format("    for (int i = 0; i < {}; ++i) {{\n{}    }}\n", block.count, body);
    return loop;
}

std::string lights_text(const ExportedScene& scene) {
    std::string text, declarations, statements;
    const std::vector<LightBlock> blocks = light_blocks(scene);
    if (!blocks.empty()) declarations = fmt::format(fmt::runtime(k_light_table), k_light_table_width);
    for (std::size_t m = 0; m < blocks.size(); ++m) {
        const LightLoop loop = loop_over(scene.light_models[m], blocks[m]);
        text += std::string(scene.light_models[m].plugin->kernel.text) + "\n";
        declarations += loop.declarations;
        statements += loop.statements;
    }
    return text + declarations +
           "\nReflected reflect_light(Surface s, vec3 to_light);\nvec3 reflect_ambient(Surface s);\n\n"
           "// The sum of the ambient, diffuse and specular light at a point.\n"
           "vec3 lights_at(Surface s, Receiver r) {\n    vec3 sum = vec3(0.0);\n" +
           statements + "    return sum;\n}\n";
}

std::string uniform_of(const ExportedModel& model, const char* name) {
    return has_parameters(model) ? fmt::format("uniform {} {};\n", model.plugin->kernel.parameters, name)
                                 : "";
}

/// Values derived from the parameters are computed once for each vertex or pixel, before the loop over its
/// lights.
std::string preparation_of(const ExportedModel& model, const char* name, const char* macro) {
    if (!has_function(model, "prepare")) return "";
    return fmt::format(
        "{0} {1}_constants;\nvoid prepare_{1}() {{ {1}_constants = {2}; }}\n#define PREPARED_{3}\n",
        constants_type(model), name, prepared(model, name), macro);
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

std::string constants_name(const ExportedModel& model, const std::string& name) {
    return has_function(model, "prepare") ? name + "_constants" : name;
}

std::string needs_text(const ExportedReflection& model) {
    return std::string(model.needs.tangent ? "#define NEEDS_TANGENT\n" : "") +
           (model.needs.position ? "#define NEEDS_POSITION\n" : "") +
           (model.needs.uv ? "#define NEEDS_UV\n" : "");
}

std::string reflection_text(const ExportedReflection& model) {
    return fmt::format(
        "{}\n{}{}{}Reflected reflect_light(Surface s, vec3 to_light) {{ return {}; }}\n"
        "vec3 reflect_ambient(Surface s) {{ return {}; }}\n",
        model.plugin->kernel.text, uniform_of(model, "material"),
        preparation_of(model, "material", "MATERIAL"), needs_text(model),
        call(model, "reflect", constants_name(model, "material"), "s, to_light"),
        call(model, "reflect_ambient", constants_name(model, "material"), "s"));
}

std::string shading_text(const ExportedShading& model) {
    constexpr const char* k_rates[] = {"#define INTENSITY_RATE flat\n", "#define INTENSITY_RATE\n",
                                       "#define LIT_AT_FRAGMENT\n"};
    const char* const triangle =
        model.needs.triangle ? "#define NEEDS_TRIANGLE\nTriangle seen_triangle;\n" : "";
    return fmt::format("{}\n{}{}{}{}vec3 shading_normal(ShadingPoint p) {{ return {}; }}\n",
                       model.plugin->kernel.text, uniform_of(model, "shading"),
                       preparation_of(model, "shading", "SHADING"), k_rates[static_cast<int>(model.rate)],
                       triangle,
                       call(model, "normal", constants_name(model, "shading"),
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

std::string stage_text(const char* text, const std::vector<Feature>& features, Values values = {}) {
    std::string declarations;
    for (const Feature& f : features) {
        if (f.is_there) declarations += f.declarations;
        values.emplace_back(
            f.place, f.is_there ? fmt::format("#ifdef {}\n    {}\n#endif\n", f.condition, f.statement) : "");
    }
    return declarations + filled(text, views_of(values));
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
        "    gl_FragDepth = is_orthographic ? 1.0 - gl_FragCoord.z : near * gl_FragCoord.w;\n"};

GlslParts glsl_of(const ExportedScene& scene, const GlslDepth& depth) {
    require_different_names(scene);
    GlslParts parts;
    const std::string lit = filled(candela_target_lit, {{"PREPARATION", calls_of_preparations(scene)}});
    parts.lights = lights_text(scene);
    for (const auto& model : scene.reflections) parts.reflections.push_back(reflection_text(model));
    for (const auto& model : scene.shadings) parts.shadings.push_back(shading_text(model));
    const bool needs_triangle = sees_triangles(scene), is_textured = !scene.textures.empty();
    constexpr const char *k_triangle = "NEEDS_TRIANGLE", *k_texture = "TEXTURED";
    parts.vertex =
        lit + stage_text(candela_target_vertex, {{needs_triangle, candela_target_triangle_vertex,
                                                  "PASS_TRIANGLE", k_triangle, "pass_triangle();"},
                                                 {is_textured, candela_target_texture_vertex, "PASS_TEXTURE",
                                                  k_texture, "pass_texture();"},
                                                 {is_textured, "", "TEXTURE_COLOR", k_texture,
                                                  "color *= color_texture_at(color_texture, uv, 0.0);"}});
    parts.fragment = lit + stage_text(candela_target_fragment,
                                      {{needs_triangle, candela_target_triangle_fragment, "READ_TRIANGLE",
                                        k_triangle, "read_triangle();"},
                                       {is_textured, candela_target_texture_fragment, "TEXTURE_COLOR",
                                        k_texture, "color *= texture_seen(at_place, at_uv);"}},
                                      {{"DEPTH_UNIFORM", depth.uniform}, {"DEPTH", depth.statement}});
    if (is_textured) parts.texture = candela_target_texture + std::string(texture_kernel()) + "\n";
    parts.screen = candela_target_screen;
    parts.accumulate = candela_target_accumulate;
    parts.encode = candela_target_encode;

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

std::vector<LightBlock> light_blocks(const ExportedScene& scene) {
    std::vector<LightBlock> blocks;
    std::size_t first = 0;
    for (std::size_t m = 0; m < scene.light_models.size(); ++m) {
        const ExportedModel& model = scene.light_models[m];
        const auto lights =
            static_cast<std::size_t>(std::ranges::count(scene.lights, m, &ExportedLight::model));
        std::size_t size = 0;
        if (has_parameters(model)) {
            for (const std::size_t i : model.plugin->kernel.members)
                size += texels_of(model.plugin->parameters[i].type);
        }
        blocks.push_back(
            {.count = light_name(model) + "_count", .lights = lights, .first = first, .size = size});
        first += size * lights;
    }
    return blocks;
}

std::size_t texels_of(ParamType type) { return type == ParamType::matrix ? 3 : 1; }

const char* rate_name(ShadingRate rate) {
    constexpr const char* k_names[] = {"face", "vertex", "fragment"};
    return k_names[static_cast<int>(rate)];
}

}  // namespace candela::target
