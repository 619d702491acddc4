#include "arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstddef>
#include <span>
#include <vector>

#include "candela/target/mirror.h"
#include "objects.h"

namespace candela::cpp_target {

namespace {

/// A positional argument of the program that names a model for all objects.
template <class Model>
struct ModelArgument {
    const char* member;
    const char* type;
    std::vector<std::string> enumerators;
    std::span<const Model> models;

    bool is_there() const { return models.size() > 1; }
    std::string names() const {
        std::vector<std::string> all;
        for (const Model& model : models) all.emplace_back(model.plugin->name);
        return fmt::format("{}", fmt::join(all, ", "));
    }
    std::string help(const char* placeholder) const {
        return is_there() ? fmt::format("\n    \"{}: of all objects: {}\\n\"", placeholder, names()) : "";
    }
    std::string statements(std::size_t position) const {
        if (!is_there()) return "";
        std::string text =
            fmt::format("        if (words.size() > {}) {{  // the {} of all objects\n", position, member);
        for (std::size_t i = 0; i < models.size(); ++i) {
            text += fmt::format(
                "            {}if (words[{}] == \"{}\")\n                for (scene::Object& o : "
                "objects) o.{} = "
                "scene::{}::{};\n",
                i == 0 ? "" : "else ", position, models[i].plugin->name, member, type, enumerators[i]);
        }
        return text + fmt::format(
                          "            else\n                throw std::runtime_error(\"unknown {} model '\" "
                          "+ words[{}] + \"'; expected one of: {}\");\n        }}\n",
                          member, position, names());
    }
};
using ShadingArgument = ModelArgument<ExportedShading>;
using ReflectionArgument = ModelArgument<ExportedReflection>;

std::string main_text(const ExportedScene& scene, const ShadingArgument& shading,
                      const ReflectionArgument& reflection) {
    const std::size_t first = 1, second = shading.is_there() ? 2 : 1;
    const std::size_t most = second + (reflection.is_there() ? 1 : 0);
    return fmt::format(
               "        const std::vector<std::string> words(argv + 1, argv + argc);\n"
               "        if (!words.empty() && (words[0] == \"--help\" || words[0] == \"-h\")) {{\n"
               "            std::cout << k_help;\n            return 0;\n        }}\n"
               "        for (std::size_t i = 0; i < words.size(); ++i) {{\n"
               "            if (i >= {} || words[i].rfind('-', 0) == 0)\n"
               "                throw std::runtime_error(\"unknown argument '\" + words[i] + \"'; --help "
               "lists them\");\n        }}\n"
               "        const std::string path = argc > 1 ? argv[1] : \"scene.png\";\n"
               "{}        std::vector<scene::Object> objects = scene::make_objects();\n",
               most,
               std::string(scene.textures.empty() ? "" : "        scene::look_for_textures_at(argv[0]);\n") +
                   (target::has_mirror_images(scene) ? "        scene::look_for_radiance_at(argv[0]);\n"
                                                     : "")) +
           shading.statements(first) + reflection.statements(second) +
           "        for (scene::Object& o : objects) {\n            scene::place(o);\n            "
           "scene::find_normals(o);\n"
           "        }\n        scene::write_picture(path, scene::bytes_of(scene::render(objects)), "
           "scene::k_width, "
           "scene::k_height);\n";
}

}  // namespace

ArgumentTexts arguments_of(const ExportedScene& scene) {
    const ShadingArgument shading{"shading", "Shading", shading_enumerators(scene), scene.shadings};
    const ReflectionArgument reflection{"reflection", "Reflection", reflection_enumerators(scene),
                                        scene.reflections};
    std::string usage = "[PICTURE", end = "]";
    if (shading.is_there()) usage += " [SHADING", end += "]";
    if (reflection.is_there()) usage += " [REFLECTION", end += "]";
    return {usage + end, shading.help("SHADING") + reflection.help("REFLECTION"),
            main_text(scene, shading, reflection)};
}

}  // namespace candela::cpp_target
