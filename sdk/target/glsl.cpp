#include "candela/target/glsl.h"

#include <fmt/format.h>

#include <algorithm>

#include "candela/embed.h"
#include "candela/target/kernels.h"

CANDELA_EMBED(candela_target_lit, CANDELA_TARGET_TEMPLATES "/lit.glsl");
CANDELA_EMBED(candela_target_vertex, CANDELA_TARGET_TEMPLATES "/vertex.glsl");
CANDELA_EMBED(candela_target_fragment, CANDELA_TARGET_TEMPLATES "/fragment.glsl");
CANDELA_EMBED(candela_target_screen, CANDELA_TARGET_TEMPLATES "/screen.glsl");
CANDELA_EMBED(candela_target_accumulate, CANDELA_TARGET_TEMPLATES "/accumulate.glsl");
CANDELA_EMBED(candela_target_encode, CANDELA_TARGET_TEMPLATES "/encode.glsl");

namespace candela::target {

namespace {

constexpr const char* k_preamble =
    "#define KERNEL\n"
    "// GLSL leaves open what becomes of the zero vector; here it stays zero.\n"
    "vec3 unit_or_zero(vec3 v) { return v * inversesqrt(max(dot(v, v), 1.0e-36)); }\n"
    "#define normalize unit_or_zero\n\n";

std::string lights_array(const ExportedModel& model) {
    return std::string(model.plugin->kernel.prefix) + "_lights";
}

/// A light model's lights: an array of uniforms, and the loop that adds them up.
struct LightLoop {
    std::string declarations;
    std::string statements;
};

LightLoop loop_over(const ExportedModel& model, std::size_t count) {
    const std::string array = lights_array(model);
    LightLoop loop;
    if (has_parameters(model))
        loop.declarations +=
            fmt::format("uniform {} {}[{}];\n", model.plugin->kernel.parameters, array, count);
    loop.declarations += fmt::format("uniform bool {}_on[{}];\n", array, count);

    const std::string light = has_parameters(model) ? array + "[i]" : "";
    std::string body;
    if (has_function(model, "sample_count")) {
        body += fmt::format(
            "        int samples = {};\n        for (int k = 0; k < samples; ++k) {{\n"
            "            Incident incident = {};\n",
            call(model, "sample_count", light, ""), call(model, "illuminate", light, "r, k"));
        body +=
            "            Reflected reflected = reflect_light(s, incident.to_light);\n"
            "            sum += reflected.diffuse * incident.diffuse + reflected.specular * "
            "incident.specular;\n        }\n";
    } else if (has_function(model, "illuminate")) {
        body += fmt::format("        Incident incident = {};\n", call(model, "illuminate", light, "r"));
        body +=
            "        Reflected reflected = reflect_light(s, incident.to_light);\n"
            "        sum += reflected.diffuse * incident.diffuse + reflected.specular * incident.specular;\n";
    }
    if (has_function(model, "illuminate_ambient"))
        body += fmt::format("        sum += reflect_ambient(s) * {};\n",
                            call(model, "illuminate_ambient", light, "r"));
    loop.statements =
        fmt::format("    for (int i = 0; i < {}; ++i) {{\n        if (!{}_on[i]) continue;\n{}    }}\n",
                    count, array, body);
    return loop;
}

std::string lights_text(const ExportedScene& scene) {
    std::string text, declarations, statements;
    for (std::size_t m = 0; m < scene.light_models.size(); ++m) {
        const auto count = std::ranges::count(scene.lights, m, &ExportedLight::model);
        const LightLoop loop = loop_over(scene.light_models[m], static_cast<std::size_t>(count));
        text += std::string(scene.light_models[m].plugin->kernel.text) + "\n";
        declarations += loop.declarations;
        statements += loop.statements;
    }
    return text + declarations +
           "\nReflected reflect_light(Surface s, vec3 to_light);\nvec3 reflect_ambient(Surface s);\n\n"
           "// What the lights do at a place: ambient, diffuse and specular light, added up.\n"
           "vec3 lights_at(Surface s, Receiver r) {\n    vec3 sum = vec3(0.0);\n" +
           statements + "    return sum;\n}\n";
}

std::string uniform_of(const ExportedModel& model, const char* name) {
    return has_parameters(model) ? fmt::format("uniform {} {};\n", model.plugin->kernel.parameters, name)
                                 : "";
}

std::string reflection_text(const ExportedReflection& model) {
    return fmt::format(
        "{}\n{}{}Reflected reflect_light(Surface s, vec3 to_light) {{ return {}; }}\n"
        "vec3 reflect_ambient(Surface s) {{ return {}; }}\n",
        model.plugin->kernel.text, uniform_of(model, "material"),
        model.needs_tangent ? "#define NEEDS_TANGENT\n" : "",
        call(model, "reflect", "material", "s, to_light"), call(model, "reflect_ambient", "material", "s"));
}

std::string shading_text(const ExportedShading& model) {
    constexpr const char* k_rates[] = {"#define INTENSITY_RATE flat\n", "#define INTENSITY_RATE\n",
                                       "#define LIT_AT_FRAGMENT\n"};
    return fmt::format("{}\n{}{}vec3 shading_normal(ShadingPoint p) {{ return {}; }}\n",
                       model.plugin->kernel.text, uniform_of(model, "shading"),
                       k_rates[static_cast<int>(model.rate)], call(model, "normal", "shading", "p"));
}

}  // namespace

GlslParts glsl_of(const ExportedScene& scene) {
    require_different_names(scene);
    GlslParts parts;
    const std::string lit = candela_target_lit;
    parts.lights = lights_text(scene);
    for (const auto& model : scene.reflections) parts.reflections.push_back(reflection_text(model));
    for (const auto& model : scene.shadings) parts.shadings.push_back(shading_text(model));
    parts.vertex = lit + candela_target_vertex;
    parts.fragment = lit + candela_target_fragment;
    parts.screen = candela_target_screen;
    parts.accumulate = candela_target_accumulate;
    parts.encode = candela_target_encode;

    std::string users = parts.lights + parts.vertex + parts.fragment;
    for (const auto* texts : {&parts.reflections, &parts.shadings}) {
        for (const std::string& text : *texts) users += text;
    }
    parts.prelude = k_preamble + needed_parts(kernel_prelude(), users) + "\n";
    return parts;
}

std::vector<LightUniform> light_uniforms(const ExportedScene& scene) {
    std::vector<std::size_t> next(scene.light_models.size());
    std::vector<LightUniform> uniforms;
    for (const ExportedLight& light : scene.lights) {
        const std::string array = lights_array(scene.light_models[light.model]);
        const std::size_t i = next[light.model]++;
        uniforms.push_back({fmt::format("{}[{}]", array, i), fmt::format("{}_on[{}]", array, i)});
    }
    return uniforms;
}

const char* rate_name(ShadingRate rate) {
    constexpr const char* k_names[] = {"face", "vertex", "fragment"};
    return k_names[static_cast<int>(rate)];
}

}  // namespace candela::target
