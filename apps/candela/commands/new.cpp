// candela new: writes a starter scene.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <string>
#include <system_error>

#include "cli/command_line.h"
#include "cli/commands.h"
#include "cli/outputs.h"
#include "console/reporting.h"
#include "programs/shell_words.h"
#include "templates/scene_templates.h"

import candela.util;

using candela::Error;
using candela::ErrorCategory;

int run_new(const std::vector<std::string>& arguments) {
    CommandLine line("candela new [FILE] [options]",
                     "Write a small commented scene to learn from and to edit: to FILE, by default "
                     "scene.toml; - prints it.");
    line.positional("file", 1);
    line.options()("force", "replace an existing file")("animation",
                                                        "write an animated scene, for candela animate");
    if (!line.parse(arguments)) return 0;

    const std::string file = line.has("file") ? line.all("file").front() : "scene.toml";
    const std::string scene = starter_scene(line.has("animation") ? Starter::film : Starter::image);
    if (file == "-") {
        std::cout << scene;
        return 0;
    }
    require_no_default_link(line, "file", file);
    std::error_code problem;
    if (!line.has("force") && std::filesystem::exists(std::filesystem::symlink_status(file, problem))) {
        throw Error(ErrorCategory::failure, fmt::format("'{}' already exists; --force replaces it", file));
    }
    candela::write_text_file(file, scene,
                             line.has("force") ? candela::Existing::replaced : candela::Existing::kept);
    say_afterwards([&] {
        return fmt::format("Wrote {}. Next, edit it and run: candela {} {}\n", file,
                           line.has("animation") ? "animate" : "render", quoted_for_shell(file));
    });
    return 0;
}
