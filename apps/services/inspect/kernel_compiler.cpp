#include "inspect/kernel_compiler.h"

#include <sstream>

import candela.plugins;

namespace fs = std::filesystem;

fs::path kernel_headers() {
    // The last folder on the search path is <prefix>/lib/candela/plugins.
    const fs::path plugins = candela::plugin_search_path({}).back();
    return plugins.parent_path().parent_path().parent_path() / "include";
}

candela::ProgramOutput run_kernel_compiler(const fs::path& compiler,
                                           const std::vector<std::string>& arguments,
                                           const fs::path& temporary) {
    // Set for the compiler only: this process's environment is shared by all of its threads.
    std::vector<std::string> words{"env", "TMPDIR=" + temporary.string(), compiler.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return candela::run_program(words);
}

std::string first_error(const std::string& messages) {
    std::istringstream lines(messages);
    lines.exceptions(std::ios::badbit);  // or std::getline() swallows std::bad_alloc, and the rest is lost
    for (std::string line; std::getline(lines, line);) {
        if (line.find("error:") != std::string::npos) return line;
    }
    return messages.substr(0, 200);
}
