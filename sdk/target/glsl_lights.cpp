#include "glsl_lights.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "candela/embed.h"
#include "candela/kernel_language/lexer.h"
#include "candela/target/glsl.h"
#include "candela/target/kernels.h"
#include "candela/target/mirror.h"
#include "candela/target/shadow_tree.h"
#include "candela/target/text_template.h"
#include "candela/target/textures.h"
#include "glsl_materials.h"

CANDELA_EMBED(candela_target_shadows, CANDELA_TARGET_TEMPLATES "/shadows.glsl");
CANDELA_EMBED(candela_target_light_passes, CANDELA_TARGET_TEMPLATES "/light_passes.glsl");
CANDELA_EMBED(candela_target_shadow_opacity, CANDELA_TARGET_TEMPLATES "/shadow_opacity.glsl");
CANDELA_EMBED(candela_target_mirror, CANDELA_TARGET_TEMPLATES "/mirror.glsl");
CANDELA_EMBED(candela_target_sample_offsets, CANDELA_TARGET_TEMPLATES "/sample_offsets.glsl");
CANDELA_EMBED(candela_target_extended_light, CANDELA_TARGET_TEMPLATES "/extended_light.glsl");
CANDELA_EMBED(candela_target_ambient_occlusion, CANDELA_TARGET_TEMPLATES "/ambient_occlusion.glsl");

namespace candela::target {

namespace {

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

/// Whether a light's kernel has that function, which describes the light as data. Descriptors list only
/// those that compute its light.
bool describes(const ExportedModel& model, std::string_view name) {
    const auto tokens = kernel_language::code_of(model.plugin->kernel.text);
    const std::string function = fmt::format("{}_{}", model.plugin->kernel.prefix, name);
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i].text == "KERNEL" && kernel_language::text_at(tokens, i + 2) == function) return true;
    }
    return false;
}

/// The text that adds up a light model's lights.
class LightLoopWriter {
  public:
    LightLoopWriter(const ExportedScene& scene, std::size_t model, const LightBlock& block)
        : scene_(scene),
          index_(model),
          model_(scene.light_models[model]),
          block_(block),
          has_samples_(has_function(model_, "sample_count")),
          is_mirrored_(is_mirrored(scene, model)) {}

    LightLoop write() {
        LightLoop loop;
        loop.declarations = fmt::format("uniform int {};\n", block_.count);
        if (has_parameters(model_)) read_parameters(loop);
        if (is_mirrored_)
            body_ += "        RadianceMap radiance = radiance_map(" +
                     texel_from_end(scene_.has_shadows ? 2 : 1) + ");\n";
        if (has_function(model_, "illuminate")) add_samples();
        if (is_mirrored_) add_mirror_image();
        if (has_function(model_, "illuminate_ambient")) add_ambient();
        loop.statements = fmt::format("    for (int i = 0; i < {}; ++i) {{\n{}    }}\n", block_.count, body_);
        return loop;
    }

    /// Whether samples vary from pixel to pixel within its lights' extents.
    bool varies() const { return scene_.has_shadows && scene_.shadows_vary && describes(model_, "extent"); }

  private:
    void read_parameters(LightLoop& loop) {
        const PluginDescriptor& plugin = *model_.plugin;
        std::vector<std::string> members;
        std::size_t offset = 0;
        for (const std::size_t i : plugin.kernel.members) {
            members.push_back(read_member(plugin.parameters[i].type, offset));
            offset += texels_of(plugin.parameters[i].type);
        }
        const std::string type = plugin.kernel.parameters, read = "read_" + light_name(model_);
        loop.declarations +=
            fmt::format("{0} {1}(int i) {{\n    int at = {2}{3} * i;\n    return {0}({4});\n}}\n", type, read,
                        block_.first == 0 ? "" : fmt::format("{} + ", block_.first), block_.size,
                        fmt::join(members, ", "));
        body_ =
            fmt::format("        {} light = {};\n", constants_type(model_), prepared(model_, read + "(i)"));
    }

    void add_samples() {
        if (scene_.has_shadows)
            body_ +=
                fmt::format("        bool can_be_blocked = is_shadowed && {}.x > 0.0;\n", shadow_settings());
        if (!has_samples_) {
            add_sample("        ");
            return;
        }
        body_ += fmt::format("        int samples = {};\n        for (int k = 0; k < samples; ++k) {{\n",
                             call(model_, "sample_count", "light", ""));
        add_sample("            ");
        body_ += "        }\n";
    }

    void add_sample(const char* indent) {
        const std::string kernel = call(model_, "illuminate", "light", has_samples_ ? "r, k" : "r");
        const auto line = [&](const std::string& text) { body_ += indent + text + "\n"; };
        const char* const k = has_samples_ ? "k" : "0";
        line(fmt::format("Incident incident = {};", kernel));
        if (varies()) {
            line(fmt::format("Punctual source = {};", description("punctual")));
            line("if (can_be_blocked) {");
            line(fmt::format("    source = moved_within(source, {}, {});", description("extent"), k));
            line("    incident = punctual_light(source, r);");
            line("}");
        }
        const char* const reflected =
            is_mirrored_
                ? "reflected.diffuse * incident.diffuse + reflected.specular * (own * incident.specular)"
                : "reflected.diffuse * incident.diffuse + reflected.specular * incident.specular";
        if (is_mirrored_)
            line(
                "float own = width > 0.0 ? highlight_share(light_density(radiance, radiance_place("
                "incident.to_light)), s.normal, s.to_observer, incident.to_light, width) : 1.0;");
        if (scene_.has_shadows)
            line(fmt::format("float reached = can_be_blocked ? visible_part(r, incident, {}) : 1.0;",
                             distance()));
        line("Reflected reflected = reflect_light(s, incident.to_light);");
        line(fmt::format(fmt::runtime(scene_.has_shadows ? "sum += reached * ({});" : "sum += {};"),
                         reflected));
    }

    void add_mirror_image() {
        body_ += fmt::format(
            "        for (int k = 0; k < mirror_samples() && width > 0.0; ++k) {{\n"
            "            MirrorSample mirrored = mirror_sample(radiance, s.normal, s.to_observer, width, "
            "k);\n"
            "            sum += {}reflect_light(s, mirrored.to_light).specular * mirrored.intensity;\n"
            "        }}\n",
            has_occlusion(scene_) ? "own_occlusion * " : "");
    }

    void add_ambient() {
        const bool has_rays = std::ranges::any_of(scene_.lights, [&](const ExportedLight& light) {
            return light.model == index_ && light.ambient_occlusion_rays > 0;
        });
        const bool is_occluded = scene_.has_shadows && has_rays;
        if (is_occluded)
            body_ += fmt::format(
                "        vec3 shadows = {};  // y: rays of its ambient occlusion, z: their length\n"
                "        float free = is_shadowed && shadows.y > 0.0 ? visible_ambient_part(r, "
                "int(shadows.y), shadows.z) : 1.0;\n",
                shadow_settings());
        body_ += fmt::format("        sum += {}{}reflect_ambient(s) * {};\n", is_occluded ? "free * " : "",
                             has_occlusion(scene_) ? "own_occlusion * " : "",
                             call(model_, "illuminate_ambient", "light", "r"));
    }

    /// The light's shadow_texel().
    std::string shadow_settings() const { return texel_from_end(1); }
    std::string texel_from_end(std::size_t place) const {
        return fmt::format("table_vec3({} + {} * i)", block_.first + block_.size - place, block_.size);
    }

    /// A call of a function for which describes() is true.
    std::string description(const char* name) const {
        return fmt::format("{}_{}(light{})", model_.plugin->kernel.prefix, name, has_samples_ ? ", k" : "");
    }

    std::string distance() const {
        if (varies()) return "length(source.position - r.position)";
        if (describes(model_, "punctual"))
            return fmt::format("length({}.position - r.position)", description("punctual"));
        if (has_function(model_, "distance"))
            return call(model_, "distance", "light", has_samples_ ? "r, k" : "r");
        const bool has_place = std::ranges::any_of(scene_.lights, [&](const ExportedLight& light) {
            return light.model == index_ &&
                   std::ranges::any_of(light.punctual, [](const PunctualLight& p) { return p.w != 0; });
        });
        if (has_place)
            throw std::runtime_error(fmt::format(
                "the kernel of {0} does not say how far away the light is, which shadows need; expected a "
                "function {1}_punctual() or {1}_distance()",
                model_.id, model_.plugin->kernel.prefix));
        return "k_infinitely_far";
    }

    const ExportedScene& scene_;
    std::size_t index_;
    const ExportedModel& model_;
    const LightBlock& block_;
    bool has_samples_, is_mirrored_;
    std::string body_;
};

/// How shaders of objects without textures read those of opacities.
std::string texture_of_shadows(const ExportedScene& scene) {
    return "#ifndef TEXTURED\n" +
           texture_functions(
               scene, "uvec4 texel_of_unit(int unit, ivec2 at) { return uvec4(0u); }  // it has none\n") +
           "#endif\n";
}

constexpr const char* k_blocked_part =
    "    if (along < 0.0 || along > reach) return false;\n"
    "    blocked_part = intBitsToFloat(tree_texel(triangle + 1).w);\n";
constexpr const char* k_textured_blocked_part =
    "    if (blocked_part < 0.0) blocked_part = textured_blocked_part(triangle, vec3(w, u, v) / whole);\n";

constexpr const char* k_shadow_picture =
    "float shadow_picture_texel(int first, int number) {\n"
    "    return float(tree_texel(first + (number >> 2))[number & 3]) / 65535.0;\n}\n\n";
constexpr const char* k_look_up_shadow_picture =
    "    ivec4 picture = tree_texel(third.z + 1);\n"
    "    ColorTexture t = ColorTexture(picture.x, picture.y, 1, picture.w % 3, picture.w / 3, -picture.z);\n"
    "    if (picture.x > 0) number = color_texture_in_level(t, 0, numbers).r;\n";

/// How shadows find opacities that differ within a triangle.
std::string varying_opacity(const ExportedScene& scene) {
    const bool has_pictures = has_shadow_pictures(scene);
    return (has_pictures ? texture_of_shadows(scene) : "") +
           filled(candela_target_shadow_opacity, {{"PICTURE", has_pictures ? k_shadow_picture : ""},
                                                  {"LOOK_UP", has_pictures ? k_look_up_shadow_picture : ""}});
}

/// The parts of the shadows' text for surfaces that light passes in part.
Values passing_texts(const ExportedScene& scene) {
    const bool passes = lets_light_through(scene), is_textured = has_textured_shadows(scene);
    const auto if_passes = [&](const char* text, const char* otherwise = "") {
        return std::string(passes ? text : otherwise);
    };
    return {{"OPACITY_COMMENT",
             if_passes(" Of the second: the part of the light that it\n"
                       "// blocks, as bits of a float; below 0: a texture or its vertices give it.")},
            {"PASSING", if_passes(candela_target_light_passes) + (is_textured ? varying_opacity(scene) : "")},
            {"OWNS_EDGES",
             if_passes("    float whole = u + v + w;\n"
                       "    bool is_owned = owns_edge(u, to_c, whole) && owns_edge(v, to_a, whole) && "
                       "owns_edge(w, to_b, whole);\n"
                       "    if (!is_owned && intBitsToFloat(tree_texel(triangle + 1).w) < 1.0) return "
                       "false;\n")},
            {"BLOCKED_PART", if_passes(k_blocked_part) + (is_textured ? k_textured_blocked_part : "")},
            {"IS_MET", if_passes("blocked_part > 0.0", "along >= 0.0 && along <= reach")},
            {"LEFT", if_passes("    float left = 1.0;\n")},
            {"BLOCKED", if_passes("left *= 1.0 - blocked_part;\n"
                                  "            if (left <= 0.0) return 0.0;",
                                  "return 0.0;")},
            {"FREE", if_passes("left", "1.0")},
            {"ZERO_OR_ONE", if_passes("", ": 1, or 0 if an object blocks it")}};
}

/// The functions that the loops call, except those of kernels.
std::string shadows_text(const ExportedScene& scene, bool varies) {
    if (!scene.has_shadows) return "";
    const bool has_occlusion = std::ranges::any_of(
        scene.lights, [](const ExportedLight& light) { return light.ambient_occlusion_rays > 0; });
    Values values = passing_texts(scene);
    values.emplace_back("LAST_COLUMN", fmt::format("{}", k_shadow_tree_width - 1));
    values.emplace_back("ROW_BITS", fmt::format("{}", std::countr_zero(unsigned{k_shadow_tree_width})));
    std::string text = filled(candela_target_shadows, views_of(values));
    if (varies || (has_occlusion && scene.shadows_vary)) text += candela_target_sample_offsets;
    if (varies) text += candela_target_extended_light;
    if (has_occlusion)
        text += filled(candela_target_ambient_occlusion,
                       {{"OFFSETS", scene.shadows_vary ? "sample_offsets(0)" : "vec2(0.0)"}});
    return text;
}

}  // namespace

std::string lights_text(const ExportedScene& scene) {
    std::string text, declarations, statements;
    const std::vector<LightBlock> blocks = light_blocks(scene);
    bool varies = false;
    if (!blocks.empty()) declarations = fmt::format(fmt::runtime(k_light_table), k_light_table_width);
    for (std::size_t m = 0; m < blocks.size(); ++m) {
        LightLoopWriter writer(scene, m, blocks[m]);
        const LightLoop loop = writer.write();
        text += std::string(scene.light_models[m].plugin->kernel.text) + "\n";
        declarations += loop.declarations;
        statements += loop.statements;
        varies = varies || writer.varies();
    }
    std::string mirror;
    const bool has_mirror = has_mirror_images(scene);
    if (has_mirror)
        mirror = filled(candela_target_mirror, {{"WIDTH", fmt::format("{}", k_radiance_width)}}) + "\n" +
                 mirror_kernel() + "\nfloat highlight_width();\n";
    return text + declarations + shadows_text(scene, varies) + mirror +
           "\nReflected reflect_light(Surface s, vec3 to_light);\nvec3 reflect_ambient(Surface s);\n\n"
           "// The sum of the ambient, diffuse and specular light at a point.\n"
           "vec3 lights_at(Surface s, Receiver r) {\n    vec3 sum = vec3(0.0);\n" +
           (has_mirror ? "    float width = highlight_width();\n" : "") + statements + "    return sum;\n}\n";
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
        if (has_mirror_images(scene)) ++size;
        if (scene.has_shadows) ++size;
        blocks.push_back(
            {.count = light_name(model) + "_count", .lights = lights, .first = first, .size = size});
        first += size * lights;
    }
    return blocks;
}

Vec3 shadow_texel(const ExportedLight& light) {
    return {light.casts_shadows ? 1.0f : 0.0f, static_cast<float>(light.ambient_occlusion_rays),
            light.ambient_occlusion_distance};
}

std::size_t texels_of(ParamType type) { return type == ParamType::matrix ? 3 : 1; }

}  // namespace candela::target
