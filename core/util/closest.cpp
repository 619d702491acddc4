module;

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

module candela.util;

import :ascii;

namespace candela {

namespace {

/// Optimal string alignment distance, ignoring case.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
    for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t cost = to_lower(a[i - 1]) == to_lower(b[j - 1]) ? 0 : 1;
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + cost});
            if (i > 1 && j > 1 && to_lower(a[i - 1]) == to_lower(b[j - 2]) &&
                to_lower(a[i - 2]) == to_lower(b[j - 1])) {
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
            }
        }
    }
    return d[a.size()][b.size()];
}

/// The number of letters that may be wrong in names of these lengths.
std::size_t allowed_distance(std::size_t a, std::size_t b) {
    return std::max<std::size_t>(1, (std::max(a, b) + 1) / 3);
}

}  // namespace

std::string suggestion(std::string_view name, std::span<const std::string> candidates,
                       std::string_view prefix) {
    const auto near = closest(name, candidates);
    return near ? fmt::format("did you mean '{}{}'?", prefix, *near) : "";
}

std::optional<std::string> closest(std::string_view name, std::span<const std::string> candidates) {
    // Longer names are not typing errors, and a name in a wrong file may have millions of letters.
    constexpr std::size_t k_longest = 256;
    const std::string* best = nullptr;
    std::size_t best_distance = 0;
    if (name.size() > k_longest) return std::nullopt;
    for (const std::string& candidate : candidates) {
        // Each extra letter counts as wrong.
        const std::size_t more =
            name.size() > candidate.size() ? name.size() - candidate.size() : candidate.size() - name.size();
        if (candidate.size() > k_longest || more > allowed_distance(name.size(), candidate.size())) continue;
        const std::size_t distance = edit_distance(name, candidate);
        if (best == nullptr || distance < best_distance) {
            best = &candidate;
            best_distance = distance;
        }
    }
    if (best == nullptr) return std::nullopt;
    return best_distance <= allowed_distance(name.size(), best->size()) ? std::optional(*best) : std::nullopt;
}

}  // namespace candela
