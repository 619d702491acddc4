#include "cli/outputs.h"

#include <fmt/format.h>
#include <unistd.h>

#include <system_error>

#include "import/model_buffers.h"

namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;
using candela::Existing;

void add_no_clobber_option(CommandLine& line) {
    line.options()("no-clobber", "do not replace an existing file");
}

Existing existing_from(const CommandLine& line) {
    return line.has("no-clobber") ? Existing::kept : Existing::replaced;
}

void require_free(const std::string& output, Existing existing) {
    if (output == "-") return;
    std::error_code problem;
    if (existing == Existing::kept && fs::is_regular_file(output, problem))
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' already exists; not overwriting it, because of --no-clobber", output));
    const fs::path folder = fs::path(output).parent_path();
    if (!folder.empty() && fs::status(folder, problem).type() == fs::file_type::not_found)
        throw Error(
            ErrorCategory::failure,
            fmt::format(
                "'{}' cannot be written: there is no folder '{}'; create it first, or choose another name",
                output, folder.string()));
}

void require_no_terminal(const std::string& output, const std::string& what) {
    if (output == "-" && ::isatty(STDOUT_FILENO) == 1) {
        throw Error(
            ErrorCategory::bad_request,
            fmt::format("-o - would print {} on this terminal; redirect it to a file or a pipe", what));
    }
}

void require_no_default_link(const CommandLine& line, const std::string& option,
                             const std::filesystem::path& output) {
    std::error_code none;
    if (line.is_given(option) || !std::filesystem::is_symlink(output, none)) return;
    throw Error(ErrorCategory::failure,
                fmt::format("the default name '{}' is a symbolic link here; to follow it, give the name",
                            output.string()));
}

void require_no_input(const std::string& output, const std::vector<fs::path>& inputs,
                      const std::string& inputs_are, const std::string& remedy) {
    std::error_code problem;
    if (output == "-" || !fs::exists(output, problem)) return;
    for (const fs::path& input : inputs) {
        if (fs::equivalent(input, output, problem) || importing::is_buffer_of(input, output))
            throw Error(ErrorCategory::bad_request,
                        fmt::format("'{}' is one of {}; {}", output, inputs_are, remedy));
    }
}

void require_no_scene_file(const std::string& output, const std::vector<fs::path>& inputs,
                           const std::string& what) {
    require_no_input(output, inputs, "the files that the scene is made from",
                     fmt::format("give {} another name", what));
}
