#include "lights.h"

#include <fmt/format.h>

#include <cstddef>

#include "candela/target/kernels.h"
#include "candela/target/literals.h"

namespace candela::cpp_target {

using namespace target;

namespace {

std::string constants(const ExportedScene& scene) {
    std::string text;
    for (std::size_t m = 0; m < scene.light_models.size(); ++m) {
        const ExportedModel& model = scene.light_models[m];
        const KernelText& kernel = model.plugin->kernel;
        std::string entries;
        std::size_t count = 0;
        for (const ExportedLight& light : scene.lights) {
            if (light.model != m) continue;
            ++count;
            if (has_parameters(model))
                entries += fmt::format("    {},  // {}\n", struct_text(model, light.values),
                                       ascii_identifier(light.label));
        }
        text += has_parameters(model) ? fmt::format("const std::vector<{}> k_{}_lights = {{\n{}}};\n\n",
                                                    constants_type(model), kernel.prefix, entries)
                                      : fmt::format("const int k_{}_lights = {};\n\n", kernel.prefix, count);
    }
    return text;
}

std::string loops(const ExportedScene& scene) {
    std::string text;
    for (const ExportedModel& model : scene.light_models) {
        const KernelText& kernel = model.plugin->kernel;
        text += has_parameters(model)
                    ? fmt::format("    for (const {}& light : k_{}_lights) {{\n", constants_type(model),
                                  kernel.prefix)
                    : fmt::format("    for (int n = 0; n < k_{}_lights; ++n) {{\n", kernel.prefix);
        const std::string add =
            "const Reflected f = reflected(o, s, i.to_light);\n{0}sum += f.diffuse * i.diffuse + "
            "f.specular * i.specular;\n";
        if (has_function(model, "sample_count")) {
            text += fmt::format(
                "        for (int k = 0; k < {}; ++k) {{\n            const Incident i = {};\n           "
                " ",
                call(model, "sample_count", "light", ""), call(model, "illuminate", "light", "r, k"));
            text += fmt::format(fmt::runtime(add), "            ") + "        }\n";
        } else if (has_function(model, "illuminate")) {
            text += fmt::format("        const Incident i = {};\n        ",
                                call(model, "illuminate", "light", "r"));
            text += fmt::format(fmt::runtime(add), "        ");
        }
        if (has_function(model, "illuminate_ambient"))
            text += fmt::format("        sum += reflected_ambient(o, s) * {};\n",
                                call(model, "illuminate_ambient", "light", "r"));
        text += "    }\n";
    }
    return text.empty() ? "    (void)o, (void)s, (void)r;  // there are no lights\n" : text;
}

}  // namespace

LightTexts lights_of(const ExportedScene& scene) { return {constants(scene), loops(scene)}; }

}  // namespace candela::cpp_target
