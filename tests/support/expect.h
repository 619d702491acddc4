// Checks the result of a run of the command.
#pragma once

#include <catch2/catch_test_macros.hpp>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/text.h"

/// Checks the exit code, and that standard error contains `parts`. Returns the result, for further checks.
inline CommandResult expect(const CommandResult& result, int exit_code,
                            const std::vector<std::string>& parts = {}) {
    INFO(result.out << result.err);
    CHECK(result.exit_code == exit_code);
    for (const std::string& part : parts) {
        INFO(part);
        CHECK(holds(result.err, part));
    }
    return result;
}

/// Like expect(), of standard output.
inline CommandResult expect_out(const CommandResult& result, int exit_code,
                                const std::vector<std::string>& parts) {
    INFO(result.out << result.err);
    CHECK(result.exit_code == exit_code);
    for (const std::string& part : parts) {
        INFO(part);
        CHECK(holds(result.out, part));
    }
    return result;
}

/// Requires that the command succeeded.
inline CommandResult succeeded(const CommandResult& result) {
    INFO(result.out << result.err);
    REQUIRE(result.exit_code == 0);
    return result;
}
