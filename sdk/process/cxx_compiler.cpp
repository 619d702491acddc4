#include "process/process.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

import candela.util;

namespace candela {

std::optional<std::filesystem::path> cxx_compiler() {
    if (const char* const chosen = std::getenv("CXX"); chosen != nullptr && *chosen != '\0') {
        if (auto found = program_called(chosen)) return found;
        // With several words, it is a command for build tools, such as "ccache g++".
        if (std::string_view(chosen).find(' ') == std::string_view::npos)
            throw Error(ErrorCategory::failure,
                        fmt::format("the environment variable CXX names the C++ compiler '{}', which is not "
                                    "installed",
                                    chosen));
    }
    constexpr int k_newest = 30, k_oldest = 9;
    for (const char* const name : {"clang++", "g++"}) {
        for (int version = k_newest; version >= k_oldest; --version) {
            if (auto found = program_called(fmt::format("{}-{}", name, version))) return found;
        }
        if (auto found = program_called(name)) return found;
    }
    return program_called("c++");
}

}  // namespace candela
