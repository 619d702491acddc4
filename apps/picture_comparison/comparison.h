// The result of a comparison, and its JSON, which is what `candela diff --json` prints.
#pragma once

#include <cstddef>
#include <string>

#include "picture_comparison/differences.h"

import candela.diagnostics;

struct Comparison {
    int width = 0, height = 0;
    Differences differences{};
    std::size_t perceptible = 0;  // pixels whose difference a person would see (Yee 2004), of all

    /// 0 to 1
    double perceptible_share() const;
};

std::string to_json(const Comparison& comparison);

/// Reads what to_json() writes; the numbers of pixels beyond a tolerance are not part of it. Throws
/// candela::Error (failure) for anything else.
Comparison comparison_from_json(const std::string& text);
