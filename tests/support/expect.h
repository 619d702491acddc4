// Checks the result of a run of the command.
#pragma once

#include <catch2/catch_test_macros.hpp>
#include <string>
#include <vector>

#include "support/command.h"

/// Checks the exit code, and that standard error contains `parts`.
inline void expect(const CommandResult& result, int exit_code, const std::vector<std::string>& parts) {
    INFO(result.err);
    CHECK(result.exit_code == exit_code);
    for (const std::string& part : parts) {
        INFO(part);
        CHECK(result.err.find(part) != std::string::npos);
    }
}
