// candela edit: writes changes into a scene's files.
#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "cli/commands.h"
#include "cli/scene_compilation.h"
#include "console/exit_code.h"
#include "console/reporting.h"
#include "import/import.h"
#include "scene_edit/scene_edit.h"

import candela.render;
import candela.util;

namespace po = boost::program_options;
namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

int run_edit(const std::vector<std::string>& arguments) {
    CommandLine line(
        "candela edit SCENE... --change PATH=VALUE [options]",
        "Write values into a scene's files, where they stand or where they belong. Comments, order and all "
        "other lines are kept. Nothing is written if the scene would have errors.");
    line.options()("change", po::value<std::vector<std::string>>()->value_name("PATH=VALUE"),
                   "write one value, such as light.lamp.intensity=3 or shading.model=flat; can be repeated");
    add_scene_options(line);
    if (!line.parse(arguments)) return 0;
    if (!line.has("scene")) throw Error(ErrorCategory::bad_request, "candela edit needs a scene file");
    const std::vector<candela::Setting> changes = settings_from(line, "change");
    if (changes.empty()) {
        throw Error(ErrorCategory::bad_request,
                    "nothing to change; use --change, as in --change image.width=640");
    }
    candela::Registry registry = registry_from(line);
    for (const std::string& file : line.all("scene")) {
        if (importing::is_model(file))
            throw Error(
                ErrorCategory::bad_request,
                fmt::format("'{}' is a model, not a scene; make a scene of it with candela import", file));
    }
    candela::SceneRequest request = scene_request_from(line, registry);
    if (!request.streams.empty())
        throw Error(ErrorCategory::bad_request,
                    "a scene read from a pipe cannot be edited: it has no file to write to");

    candela::Diagnostics diagnostics;
    const auto texts = candela::edited_files(request, changes, registry, diagnostics);
    for (const candela::TextChange& text : texts) request.unsaved[text.file] = text.after;
    request.ask = nullptr;
    // Some errors show only in the triangles, such as a light inside an object.
    if (!diagnostics.has_errors()) {
        diagnostics = {};
        const auto draft = candela::draft_scene(request, registry, diagnostics);
        if (draft) static_cast<void>(compile_scene(*draft, registry, diagnostics));
    }
    report(diagnostics);
    if (diagnostics.has_errors()) return static_cast<int>(exit_code_of(diagnostics));
    std::string lines;
    for (const candela::TextChange& text : texts)
        lines += fmt::format("{}: changed\n", text.file.lexically_proximate(fs::current_path()).string());
    if (texts.empty()) lines = "No changes: the files already have these values.\n";
    candela::replace_texts(texts);
    say_afterwards([&] { return lines; });
    return 0;
}
