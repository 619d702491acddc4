// What a run of the command is to come to.
#pragma once

#include <catch2/catch_test_macros.hpp>
#include <string>
#include <vector>

#include "support/command.h"

/// Its exit code, and what it says on standard error, among other things.
inline void expect(const CommandResult& result, int exit_code, const std::vector<std::string>& parts) {
    INFO(result.err);
    CHECK(result.exit_code == exit_code);
    for (const std::string& part : parts) {
        INFO(part);
        CHECK(result.err.find(part) != std::string::npos);
    }
}
