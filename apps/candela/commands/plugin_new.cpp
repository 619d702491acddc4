// candela plugin new: creates a plugin project from the installed template or from another model's kernel.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "candela/kernel_language/language.h"
#include "cli/command_line.h"
#include "commands/plugin.h"
#include "console/reporting.h"
#include "exercise/exercises.h"
#include "files/output_folder.h"
#include "plugin_project/plugin_project.h"

import candela.util;

namespace po = boost::program_options;
namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

namespace {

constexpr std::size_t k_largest_kernel = 1'000'000;  // bytes

/// The kernel text to start from: the named file, otherwise the model's own.
std::string kernel_from(const CommandLine& line, const candela::PluginFile& model) {
    if (!line.has("kernel")) return model.descriptor->kernel.text;
    const auto file = line.get<std::string>("kernel");
    auto text = candela::read_text_file(file, k_largest_kernel);
    if (!text) throw Error(ErrorCategory::failure, fmt::format("'{}' cannot be read", file));
    if (text->size() > k_largest_kernel || candela::first_invalid_byte(*text))
        throw Error(ErrorCategory::bad_request, fmt::format("'{}' is not a kernel's text", file));
    // It may come from a page, and will be compiled.
    try {
        static_cast<void>(candela::kernel_language::read_kernel({fs::path(file).filename().string(), *text}));
    } catch (const candela::kernel_language::Problem& problem) {
        throw Error(ErrorCategory::bad_request, problem.text());
    }
    return *std::move(text);
}

}  // namespace

int run_plugin_new(const std::vector<std::string>& arguments) {
    CommandLine line("candela plugin new KIND NAME [DIR]",
                     "Create a plugin project in DIR, by default NAME: source, kernel if the kind has one, "
                     "CMakeLists.txt, test and README. KIND is light, reflection, shading, shape, image or "
                     "target. The project builds and passes its tests as it is.");
    line.positional("arguments", 3);
    line.options()(
        "from", po::value<std::string>()->value_name("MODEL"),
        "start from the kernel and parameters of this light, reflection or shading model, or of this "
        "kernel file, instead of the template's")(
        "kernel", po::value<std::string>()->value_name("FILE"),
        "with --from: use this kernel text instead of the model's own, as the page of candela view does");
    add_plugin_options(line);
    if (!line.parse(arguments)) return 0;
    const std::vector<std::string> words = line.all("arguments");
    if (words.size() < 2)
        throw Error(ErrorCategory::bad_request,
                    "candela plugin new needs a kind and a name, such as: reflection cel");
    const std::vector<std::string> kinds{"light", "reflection", "shading", "shape", "image", "target"};
    const auto kind = candela::plugin_kind_named(words[0]);
    if (!kind) {
        const std::string meant = candela::suggestion(words[0], kinds);
        throw Error(ErrorCategory::bad_request,
                    fmt::format("there is no template for '{}'{} (kinds: {})", words[0],
                                meant.empty() ? "" : "; " + meant, fmt::join(kinds, ", ")));
    }
    if (line.has("kernel") && !line.has("from"))
        throw Error(ErrorCategory::bad_request,
                    "--kernel needs --from: the model whose parameters the text reads");
    if (line.has("from") && kind > candela::PluginKind::shading)
        throw Error(ErrorCategory::bad_request,
                    "--from starts from a model's kernel; expected the kind light, reflection or shading");
    const ProjectNames names = project_names(words[1]);
    const fs::path target = words.size() > 2 ? words[2] : words[1];
    if (fs::exists(target) && !(fs::is_directory(target) && fs::is_empty(target)))
        throw Error(ErrorCategory::failure, fmt::format("'{}' already exists", target.string()));
    candela::Registry registry = registry_from(line);
    std::vector<candela::ExportedFile> files = template_files(words[0], names);
    if (line.has("from")) {
        const auto from = line.get<std::string>("from");
        const candela::PluginFile& model = loaded_model(*kind, from, registry);
        // The author of a kernel file has described it already; an installed model has another author.
        const Description description =
            candela::is_kernel_file(from) ? Description::of_the_kernel : Description::to_be_written;
        for (candela::ExportedFile& file : files_like(model, kernel_from(line, model), names, description)) {
            std::erase_if(files, [&](const candela::ExportedFile& other) { return other.name == file.name; });
            files.push_back(std::move(file));
        }
    }
    OutputFolder folder(target);
    for (const candela::ExportedFile& file : files) folder.write(file.name, file.content);
    folder.finish();
    if (const auto* const hidden = registry.find(*kind, words[1]))
        warn(fmt::format(
            "a {} plugin '{}' already exists ({}); the new one hides it wherever it is found first", words[0],
            words[1], hidden->library.string()));
    std::cout << fmt::format(
        "Created {0}. Next:\n  cd {0}\n  cmake -B build -DCMAKE_BUILD_TYPE=Release\n"
        "  cmake --build build && ctest --test-dir build\n",
        target.string());
    return 0;
}
