#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers.hpp>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "process/process.h"
#include "support/command.h"

import candela.util;

namespace fs = std::filesystem;

namespace {

/// A folder that is the whole PATH, for dummy programs.
class Programs {
  public:
    Programs() : folder_(scratch_directory()) {
        ::setenv("PATH", folder_.c_str(), 1);
        ::unsetenv("CXX");
    }
    void add(const char* name) const {
        fs::permissions(write_file(folder_ / name, ""), fs::perms::owner_exec, fs::perm_options::add);
    }

  private:
    fs::path folder_;
};

fs::path found() { return candela::cxx_compiler().value_or("none").filename(); }

}  // namespace

TEST_CASE(
    "of several C++ compilers, the newest clang++ is found, otherwise the newest g++, with or without a "
    "version") {
    const Programs programs;
    CHECK(found() == "none");
    programs.add("c++");
    CHECK(found() == "c++");
    programs.add("g++");
    CHECK(found() == "g++");
    programs.add("g++-9");
    programs.add("g++-13");
    CHECK(found() == "g++-13");
    programs.add("clang++");
    CHECK(found() == "clang++");
    programs.add("clang++-14");
    CHECK(found() == "clang++-14");
    programs.add("clang++-20");
    CHECK(found() == "clang++-20");
}

TEST_CASE("CXX names the C++ compiler, which must be installed, unless it is a command of several words") {
    const Programs programs;
    programs.add("clang++-20");
    programs.add("g++-9");
    ::setenv("CXX", "g++-9", 1);
    CHECK(found() == "g++-9");
    ::setenv("CXX", "icpx", 1);
    CHECK_THROWS_WITH(found(),
                      "the environment variable CXX names the C++ compiler 'icpx', which is not installed");
    ::setenv("CXX", "ccache g++-9", 1);
    CHECK(found() == "clang++-20");
    ::setenv("CXX", "", 1);
    CHECK(found() == "clang++-20");
}
