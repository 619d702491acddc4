#include "glsl_lights.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "candela/target/glsl.h"
#include "candela/target/kernels.h"

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

}  // namespace

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

}  // namespace candela::target
