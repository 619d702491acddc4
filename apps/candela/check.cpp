// candela check: what is wrong with a scene.
#include <fmt/format.h>

#include <iostream>

#include "command_line.h"
#include "terminal.h"
#include "verbs.h"

int run_check(const std::vector<std::string>& arguments) {
    CommandLine line(
        "candela check SCENE... [options]",
        "Reads a scene, or several files that together are one, and says all that is wrong with it.");
    add_scene_options(line);
    line.options()("print", "print the scene as one file: includes, --set and all defaults put in");
    if (!line.parse(arguments)) return 0;
    if (!line.has("scene"))
        throw candela::Error(candela::ExitCode::usage, "candela check needs a scene file");

    candela::Registry registry = registry_from(line);
    candela::Diagnostics diagnostics;
    candela::SceneRequest request = scene_request_from(line);
    // A check says the same wherever it runs, and never waits: where `render` would ask, it says what is
    // missing.
    request.ask = nullptr;
    const auto scene = candela::read_scene(request, registry, diagnostics);
    std::cerr << diagnostics.text(stderr_takes_color());
    if (!scene) return static_cast<int>(diagnostics.exit_code());
    if (line.has("print")) {
        std::cout << candela::scene_text(*scene);
        return 0;
    }
    const auto count = [](std::size_t n, const char* what) {
        return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
    };
    std::cout << fmt::format("The scene is valid: {}, {}, {} x {} pixels.\n",
                             count(scene->lights.size(), "light"), count(scene->objects.size(), "object"),
                             scene->image.width, scene->image.height);
    return 0;
}
