#include "glsl_program.h"

#include <fmt/format.h>

#include <algorithm>

namespace generate {

namespace {

constexpr const char* k_preamble =
    "#define KERNEL\n"
    "// GLSL leaves open what becomes of the zero vector; here it stays zero.\n"
    "vec3 unit_or_zero(vec3 v) { return v * inversesqrt(max(dot(v, v), 1.0e-36)); }\n"
    "#define normalize unit_or_zero\n\n";

/// A light model's lights: an array of uniforms, and the loop that adds them up.
struct LightLoop {
    std::string declarations;
    std::string statements;
};

LightLoop loop_over(const ExportedModel& model, std::size_t count) {
    const KernelSource& kernel = model.kernel;
    const std::string array = kernel.prefix() + "_lights";
    const bool has_parameters = kernel.parameters() != nullptr;
    LightLoop loop;
    if (has_parameters)
        loop.declarations += fmt::format("uniform {} {}[{}];\n", kernel.parameters()->name, array, count);
    loop.declarations += fmt::format("uniform bool {}_on[{}];\n", array, count);

    const std::string light = has_parameters ? array + "[i]" : "";
    std::string body;
    if (kernel.function("sample_count") != nullptr) {
        body += fmt::format(
            "        int samples = {};\n        for (int k = 0; k < samples; ++k) {{\n"
            "            Incident incident = {};\n",
            kernel.call("sample_count", light, ""), kernel.call("illuminate", light, "r, k"));
        body +=
            "            Reflected reflected = reflect_light(s, incident.to_light);\n"
            "            sum += reflected.diffuse * incident.diffuse + reflected.specular * "
            "incident.specular;\n        }\n";
    } else if (kernel.function("illuminate") != nullptr) {
        body += fmt::format("        Incident incident = {};\n", kernel.call("illuminate", light, "r"));
        body +=
            "        Reflected reflected = reflect_light(s, incident.to_light);\n"
            "        sum += reflected.diffuse * incident.diffuse + reflected.specular * incident.specular;\n";
    }
    if (kernel.function("illuminate_ambient") != nullptr)
        body += fmt::format("        sum += reflect_ambient(s) * {};\n",
                            kernel.call("illuminate_ambient", light, "r"));
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
        text += scene.light_models[m].kernel.text() + "\n";
        declarations += loop.declarations;
        statements += loop.statements;
    }
    return text + declarations +
           "\nReflected reflect_light(Surface s, vec3 to_light);\nvec3 reflect_ambient(Surface s);\n\n"
           "// What the lights do at a place: ambient, diffuse and specular light, added up.\n"
           "vec3 lights_at(Surface s, Receiver r) {\n    vec3 sum = vec3(0.0);\n" +
           statements + "    return sum;\n}\n";
}

std::string uniform_of(const KernelSource& kernel, const char* name) {
    return kernel.parameters() == nullptr ? ""
                                          : fmt::format("uniform {} {};\n", kernel.parameters()->name, name);
}

std::string reflection_text(const ExportedReflection& model) {
    const KernelSource& kernel = model.kernel;
    return fmt::format(
        "{}\n{}{}Reflected reflect_light(Surface s, vec3 to_light) {{ return {}; }}\n"
        "vec3 reflect_ambient(Surface s) {{ return {}; }}\n",
        kernel.text(), uniform_of(kernel, "material"), model.needs_tangent ? "#define NEEDS_TANGENT\n" : "",
        kernel.call("reflect", "material", "s, to_light"), kernel.call("reflect_ambient", "material", "s"));
}

std::string shading_text(const ExportedShading& model) {
    const KernelSource& kernel = model.kernel;
    constexpr const char* k_rates[] = {"#define INTENSITY_RATE flat\n", "#define INTENSITY_RATE\n",
                                       "#define LIT_AT_FRAGMENT\n"};
    return fmt::format("{}\n{}{}vec3 shading_normal(ShadingPoint p) {{ return {}; }}\n", kernel.text(),
                       uniform_of(kernel, "shading"), k_rates[static_cast<int>(model.rate)],
                       kernel.call("normal", "shading", "p"));
}

}  // namespace

GlslParts glsl_of(const ExportedScene& scene, const Templates& templates) {
    GlslParts parts;
    const std::string lit = templates.text("glsl/lit.glsl");
    parts.lights = lights_text(scene);
    for (const auto& model : scene.reflections) parts.reflections.push_back(reflection_text(model));
    for (const auto& model : scene.shadings) parts.shadings.push_back(shading_text(model));
    parts.vertex = lit + templates.text("glsl/vertex.glsl");
    parts.fragment = lit + templates.text("glsl/fragment.glsl");
    parts.screen = templates.text("glsl/screen.glsl");
    parts.accumulate = templates.text("glsl/accumulate.glsl");
    parts.encode = templates.text("glsl/encode.glsl");

    std::string users = parts.lights + parts.vertex + parts.fragment;
    for (const auto* texts : {&parts.reflections, &parts.shadings}) {
        for (const std::string& text : *texts) users += text;
    }
    parts.prelude = k_preamble + needed_parts(templates.text("prelude.kernel"), users) + "\n";
    return parts;
}

std::vector<LightUniform> light_uniforms(const ExportedScene& scene) {
    std::vector<std::size_t> next(scene.light_models.size());
    std::vector<LightUniform> uniforms;
    for (const ExportedLight& light : scene.lights) {
        const std::string array = scene.light_models[light.model].kernel.prefix() + "_lights";
        const std::size_t i = next[light.model]++;
        uniforms.push_back({fmt::format("{}[{}]", array, i), fmt::format("{}_on[{}]", array, i)});
    }
    return uniforms;
}

const char* rate_name(candela::ShadingRate rate) {
    constexpr const char* k_names[] = {"face", "vertex", "fragment"};
    return k_names[static_cast<int>(rate)];
}

}  // namespace generate
