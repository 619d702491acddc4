#include "candela/target/building.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace candela::target {

namespace {

std::vector<const char*> pointers_to(const std::vector<std::string>& words) {
    std::vector<const char*> pointers;
    for (const std::string& word : words) pointers.push_back(word.c_str());
    return pointers;
}

/// CMake's option for the compiler: none, if CMake finds one by itself; otherwise the newest one with a
/// versioned name, as Debian installs them.
std::vector<std::string> compiler_option(ProgramRunner& programs) {
    constexpr std::array k_known_to_cmake = {"c++", "g++", "clang++"};
    if (std::getenv("CXX") != nullptr ||
        std::ranges::any_of(k_known_to_cmake, [&](const char* name) { return programs.has(name); }))
        return {};
    constexpr int k_newest = 30, k_oldest = 9;
    for (int version = k_newest; version >= k_oldest; --version) {
        for (const char* const name : {"clang++", "g++"}) {
            const std::string versioned = fmt::format("{}-{}", name, version);
            if (programs.has(versioned.c_str())) return {"-DCMAKE_CXX_COMPILER=" + versioned};
        }
    }
    throw std::runtime_error("no C++ compiler is installed; install g++ or clang");
}

}  // namespace

std::string tail(const std::string& log) {
    constexpr std::size_t k_most = 3000;
    return log.size() <= k_most ? log : "...\n" + log.substr(log.size() - k_most);
}

void run(ProgramRunner& programs, const std::vector<std::string>& words, const std::string& problem) {
    const ProgramResult result = programs.run(pointers_to(words));
    if (result.exit_code == 0) return;
    throw std::runtime_error(fmt::format("{} (exit code {}):\n{}", problem, result.exit_code,
                                         tail(std::string(result.out) + result.err)));
}

int show(ProgramRunner& programs, const std::vector<std::string>& words) {
    return programs.show(pointers_to(words));
}

void build_with_cmake(ProgramRunner& programs, const std::string& directory, std::string_view name) {
    const std::string binary = directory + "/build";
    std::vector<std::string> configure = {"cmake", "-S",   directory,
                                          "-B",    binary, "-DCMAKE_BUILD_TYPE=Release"};
    for (std::string& option : compiler_option(programs)) configure.push_back(std::move(option));
    run(programs, configure, fmt::format("the {} program cannot be configured", name));
    run(programs, {"cmake", "--build", binary}, fmt::format("the {} program does not compile", name));
}

}  // namespace candela::target
