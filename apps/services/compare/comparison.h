// The result of a comparison, and its JSON, as printed by `candela diff --json`.
#pragma once

#include <cstddef>
#include <string>

#include "compare/differences.h"

import candela.util;

struct Comparison {
    int width = 0, height = 0;
    Differences differences{};
    std::size_t perceptible = 0;  // of all pixels, those that differ visibly (Yee 2004)

    /// 0 to 1
    double perceptible_share() const;
};

std::string to_json(const Comparison& comparison);

/// Reads the output of to_json(), which does not include the numbers of pixels beyond a tolerance. Throws
/// candela::Error (failure) for anything else.
Comparison comparison_from_json(const std::string& text);
