// Exit codes of the command and of its companion programs.
#pragma once

import candela.util;

enum class ExitCode : int { ok = 0, failure = 1, usage = 2, invalid_scene = 3, verification_failed = 4 };

constexpr ExitCode exit_code_of(candela::ErrorCategory category) {
    switch (category) {
        case candela::ErrorCategory::bad_request:
            return ExitCode::usage;
        case candela::ErrorCategory::invalid_scene:
            return ExitCode::invalid_scene;
        default:
            return ExitCode::failure;
    }
}

inline ExitCode exit_code_of(const candela::Diagnostics& diagnostics) {
    const auto worst = diagnostics.worst();
    return worst ? exit_code_of(*worst) : ExitCode::ok;
}
