// Generated programs are built with an available compiler.
#include "candela/target/building.h"

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cstdlib>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

/// A machine on which only some programs are installed, and everything works.
class Machine final : public candela::ProgramRunner {
  public:
    explicit Machine(std::set<std::string> installed) : installed_(std::move(installed)) {}

    bool has(const char* program) override { return installed_.contains(program); }
    candela::ProgramResult run(std::span<const char* const> words) override {
        runs.emplace_back(words.begin(), words.end());
        return {};
    }
    int show(std::span<const char* const> /*words*/) override { return 0; }

    std::vector<std::vector<std::string>> runs;

  private:
    std::set<std::string> installed_;
};

/// The compiler that CMake is told to use on such a machine; empty if CMake chooses.
std::string compiler_on(std::set<std::string> installed) {
    unsetenv("CXX");
    Machine machine(std::move(installed));
    candela::target::build_with_cmake(machine, "/somewhere", "C++");
    REQUIRE(machine.runs.size() == 2);
    const std::string option = "-DCMAKE_CXX_COMPILER=";
    const auto found = std::ranges::find_if(
        machine.runs[0], [&](const std::string& word) { return word.starts_with(option); });
    return found == machine.runs[0].end() ? "" : found->substr(option.size());
}

}  // namespace

TEST_CASE(
    "a generated program is built with CMake's choice of compiler, or with the newest one with a version in "
    "its name") {
    CHECK(compiler_on({"c++", "clang++-19"}).empty());
    CHECK(compiler_on({"g++", "g++-12"}).empty());
    CHECK(compiler_on({"clang++-19"}) == "clang++-19");
    CHECK(compiler_on({"g++-12", "clang++-14", "clang++-19"}) == "clang++-19");
    CHECK_THROWS_AS(compiler_on({"cmake"}), std::runtime_error);
}
