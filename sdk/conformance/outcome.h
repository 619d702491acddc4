// The result of one group of checks.
#pragma once

#include <string>
#include <vector>

enum class Verdict { passed, warning, skipped, failed, crashed, timed_out };

const char* name_of(Verdict verdict);

/// Whether a plugin with this verdict conforms.
constexpr bool is_acceptable(Verdict verdict) {
    return verdict == Verdict::passed || verdict == Verdict::warning || verdict == Verdict::skipped;
}

struct Outcome {
    std::string group;
    Verdict verdict = Verdict::passed;
    std::vector<std::string> messages;  // what failed, why it was skipped, what a person should look at
    double seconds = 0;
};
