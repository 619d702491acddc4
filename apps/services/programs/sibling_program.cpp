#include "programs/sibling_program.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

fs::path beside_command(const char* relative) {
    const fs::path program = fs::canonical("/proc/self/exe"), above = program.parent_path().parent_path();
    // bin/candela or lib/candela/candela-verbs
    return (program.filename() == "candela-verbs" ? above.parent_path() : above) / relative;
}

fs::path sibling_program(const char* program, const char* what, const char* where_from) {
    const fs::path file = beside_command("lib/candela") / program;
    if (!fs::exists(file)) {
        throw Error(ErrorCategory::failure, fmt::format("{} is not installed: '{}' does not exist ({})", what,
                                                        file.string(), where_from));
    }
    return file;
}

fs::path comparing_program() {
    return sibling_program("candela-diff", "the program that compares pictures",
                           "package candela-openimageio");
}

fs::path all_verbs() {
    const fs::path file = beside_command("lib/candela/candela-verbs");
    if (!fs::exists(file)) {
        throw Error(ErrorCategory::failure,
                    fmt::format("this is not built yet: scripts/render.sh builds only what most pictures "
                                "need, and 'cmake --build build/release' the rest ('{}' does not exist)",
                                file.string()));
    }
    return file;
}

fs::path conformance_kit() {
    return sibling_program("candela-conformance", "the conformance kit",
                           "package candela-dev, or a build with tests");
}

void exec_sibling(const fs::path& file, const std::vector<std::string>& arguments) {
    std::vector<std::string> words{file.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    ::execv(file.c_str(), argv.data());
    throw Error(ErrorCategory::failure,
                fmt::format("'{}' cannot be run: {}", file.string(), std::strerror(errno)));
}
