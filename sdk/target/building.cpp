#include "candela/target/building.h"

#include <fmt/format.h>

#include <stdexcept>

namespace candela::target {

namespace {

std::vector<const char*> pointers_to(const std::vector<std::string>& words) {
    std::vector<const char*> pointers;
    for (const std::string& word : words) pointers.push_back(word.c_str());
    return pointers;
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
    run(programs, {"cmake", "-S", directory, "-B", binary, "-DCMAKE_BUILD_TYPE=Release"},
        fmt::format("the {} program cannot be configured", name));
    run(programs, {"cmake", "--build", binary}, fmt::format("the {} program does not compile", name));
}

}  // namespace candela::target
