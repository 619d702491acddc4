#include "inspect/kernel_run.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "candela/kernel_language/compiler.h"
#include "candela/kernel_language/kernel_cache.h"
#include "process/process.h"

import candela.util;

namespace fs = std::filesystem;
namespace kl = candela::kernel_language;
using candela::PluginDescriptor;

namespace {

/// In a folder of this process.
void write_text(const fs::path& file, std::string_view text) {
    candela::OutputFile output(file);
    output.write(text);
    output.finish(candela::Durability::fast);
}

}  // namespace

KernelRunner::KernelRunner(std::vector<const PluginDescriptor*> plugins, fs::path kept)
    : program_(std::move(plugins)),
      kept_(std::move(kept)),
      folder_("candela-explain-", kept_.empty() ? fs::temp_directory_path() : kept_) {}

void KernelRunner::prepare() {
    if (std::exchange(is_prepared_, true)) return;
    const fs::path include = kl::kernel_headers();
    std::error_code problem;
    if (include.empty()) {
        why_not_ =
            "the kernels' steps are left out: Candela's headers are not installed (package "
            "candela-dev)";
        return;
    }
    const std::string prelude = program_.traced_prelude(
        candela::read_text_file(include / "candela/kernel/prelude.kernel").value_or(""));
    const std::string text =
        fmt::format("// with headers {}\n", kl::ContentHash().add_headers(include).text()) +
        program_.source();
    const fs::path kept_program =
        kept_.empty() ? fs::path() : kept_ / kl::ContentHash().add(prelude).add(text).text();
    const bool is_there = !kept_.empty() && kl::is_kept(kept_program) &&
                          candela::read_text_file(kept_program / "kernels.cpp") == text &&
                          candela::read_text_file(kept_program / "candela/kernel/prelude.kernel") == prelude;
    const fs::path made = folder_.path() / "program";
    if (!is_there) {
        fs::create_directories(made / "candela/kernel");
        write_text(made / "candela/kernel/prelude.kernel", prelude);
        write_text(made / "kernels.cpp", text);
        if (!compile(made)) return;
        // If it cannot be kept, it runs where it was made.
        if (!kept_.empty()) static_cast<void>(kl::keep(made, kept_program));
    }
    executable_ = (fs::exists(made / "kernels", problem) ? made : kept_program) / "kernels";
}

bool KernelRunner::compile(const fs::path& folder) {
    std::optional<fs::path> program;
    try {
        program = candela::cxx_compiler();
    } catch (const candela::Error& problem) {
        why_not_ = fmt::format("the kernels' steps are left out: {}", problem.what());
        return false;
    }
    if (!program) {
        why_not_ = "the kernels' steps are left out: no C++ compiler is installed";
        return false;
    }
    // The compiler searches this folder before that of kernel.h, for "candela/kernel/prelude.kernel".
    const kl::CompilerReport report =
        kl::compile(*program, {.options = {"-O0", "-w", "-fno-math-errno", "-ffp-contract=off", "-I",
                                           folder.string(), "-I", kl::kernel_headers().string()},
                               .inputs = {folder / "kernels.cpp"},
                               .output = folder / "kernels",
                               .temporary = folder_.path()});
    if (report.is_success) return true;
    why_not_ = fmt::format("the kernels' steps are left out: {} could not compile them: {}",
                           program->filename().string(), kl::first_error(report.log));
    return false;
}

KernelValues KernelRunner::run(const std::vector<KernelCall>& calls) {
    KernelValues values(calls.size());
    if (calls.empty()) return values;
    prepare();
    if (!why_not_.empty()) return values;
    const std::vector<float> input = program_.input(calls);
    const fs::path file = folder_.path() / "input";
    write_text(file, std::string(reinterpret_cast<const char*>(input.data()), sizeof(float) * input.size()));
    const candela::ProgramOutput run = candela::run_program({executable_.string(), file.string()});
    if (run.exit_code != 0) {
        why_not_ = "the kernels' steps are left out: the compiled kernels cannot be run";
        return values;
    }
    read(run.out, values);
    return values;
}

void KernelRunner::read(const std::string& printed, KernelValues& values) const {
    std::istringstream lines(printed);
    lines.exceptions(std::ios::badbit);  // or std::getline() swallows std::bad_alloc, and the rest is lost
    std::size_t call = 0;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        words.exceptions(std::ios::badbit);  // as above
        std::string kind;
        std::size_t number = 0;
        words >> kind >> number;
        if (kind == "call") {
            call = number;
            continue;
        }
        KernelValue value{.step = &program_.steps().at(number)};
        words >> value.depth >> value.member;
        if (value.member == ".") value.member.clear();
        if (kind == "note") --value.depth;
        for (std::string word; words >> word;) value.numbers.push_back(std::strtod(word.c_str(), nullptr));
        values.at(call).push_back(std::move(value));
    }
}
