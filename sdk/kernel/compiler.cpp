#include "candela/kernel_language/compiler.h"

#include <sstream>
#include <system_error>

#include "process/process.h"

import candela.plugins;
import candela.util;

namespace fs = std::filesystem;

namespace candela::kernel_language {

fs::path kernel_headers() {
    // The last folder on the search path is next to the core's library, in <prefix>/lib or a folder in it.
    std::error_code problem;
    for (fs::path above = plugin_search_path({}).back(); above.has_relative_path();
         above = above.parent_path()) {
        if (fs::exists(above / "include/candela/kernel/kernel.h", problem)) return above / "include";
    }
    return {};
}

CompilerReport compile(const fs::path& compiler, const Compilation& compilation) {
    // The variable is set for the compiler only: this process's environment is shared by all of its threads.
    std::vector<std::string> words{"env", "TMPDIR=" + compilation.temporary.string(), compiler.string(),
                                   "-std=c++20"};
    words.insert(words.end(), compilation.options.begin(), compilation.options.end());
    for (const fs::path& input : compilation.inputs) words.push_back(input.string());
    words.insert(words.end(), {"-o", compilation.output.string()});
    const ProgramOutput output = run_program(words);
    return {.is_success = output.exit_code == 0, .log = output.err};
}

std::vector<std::string> lines_of(const std::string& log, std::size_t most,
                                  const std::function<bool(const std::string&)>& is_wanted) {
    std::istringstream lines(log);
    lines.exceptions(std::ios::badbit);  // or std::getline() swallows std::bad_alloc, and the rest is lost
    std::vector<std::string> wanted;
    for (std::string line; wanted.size() < most && std::getline(lines, line);) {
        if (is_wanted(line)) wanted.push_back(line);
    }
    return wanted;
}

std::string first_error(const std::string& log) {
    const std::vector<std::string> errors =
        lines_of(log, 1, [](const std::string& line) { return line.find("error:") != std::string::npos; });
    return errors.empty() ? log.substr(0, 200) : errors.front();
}

}  // namespace candela::kernel_language
