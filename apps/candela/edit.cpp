// candela edit: changes of a scene, written into its files.
#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

#include "command_line.h"
#include "compiling.h"
#include "exit_code.h"
#include "import/import.h"
#include "reporting.h"
#include "verbs.h"

import candela.files;
import candela.render;

namespace po = boost::program_options;
namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

int run_edit(const std::vector<std::string>& arguments) {
    CommandLine line(
        "candela edit SCENE... --change PATH=VALUE [options]",
        "Writes values into a scene's files, where they stand or where they belong. Comments, order "
        "and all other\nlines stay. Nothing is written if the scene would have errors.");
    line.options()("change", po::value<std::vector<std::string>>()->value_name("PATH=VALUE"),
                   "write one value, such as light.lamp.intensity=3 or shading.model=flat; may be repeated");
    add_scene_options(line);
    if (!line.parse(arguments)) return 0;
    if (!line.has("scene")) throw Error(ErrorCategory::bad_request, "candela edit needs a scene file");
    const std::vector<candela::Setting> changes = settings_from(line, "change");
    if (changes.empty()) {
        throw Error(ErrorCategory::bad_request,
                    "nothing is to be changed; say what, as in --change image.width=640");
    }
    candela::Registry registry = registry_from(line);
    for (const std::string& file : line.all("scene")) {
        if (importing::is_model(file))
            throw Error(
                ErrorCategory::bad_request,
                fmt::format("'{}' is a model and no scene; candela import makes a scene of it", file));
    }
    candela::SceneRequest request = scene_request_from(line, registry);
    if (!request.streams.empty())
        throw Error(ErrorCategory::bad_request, "a scene that is read from a pipe has no file to write into");

    candela::Diagnostics diagnostics;
    const auto texts = candela::edited_files(request, changes, registry, diagnostics);
    for (const candela::TextChange& text : texts) request.unsaved[text.file] = text.after;
    request.ask = nullptr;
    // What only triangles tell: whether a light is inside an object, for one.
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
    if (texts.empty()) lines = "Nothing is changed: the files say this already.\n";
    candela::replace_texts(texts);
    say_afterwards([&] { return lines; });
    return 0;
}
