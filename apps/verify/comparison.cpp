#include "verify/comparison.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "generate/building.h"

import candela.core;

using candela::Error;
using candela::ErrorCategory;
namespace fs = std::filesystem;

namespace verify {

namespace {

Figures figures_from(const nlohmann::json& json) {
    if (json.is_null()) return {};
    return {.pixels = json.at("pixels"),
            .identical = json.at("identical"),
            .maximum = json.at("maximum"),
            .mean = json.at("mean")};
}

}  // namespace

Comparison compare(const fs::path& program, const fs::path& a, const fs::path& b, const fs::path& edges,
                   const fs::path& heat_map) {
    const generate::ToolResult result =
        generate::run_tool({program.string(), a.string(), b.string(), "--mask", edges.string(), "-o",
                            heat_map.string(), "--json"});
    if (result.exit_code != 0)
        throw Error(ErrorCategory::failure, fmt::format("the pictures cannot be compared:\n{}", result.err));
    try {
        const auto json = nlohmann::json::parse(result.out);
        return {.interior = figures_from(json.at("interior")),
                .edges = figures_from(json.at("edges")),
                .perceptible = json.at("perceptible").at("pixels")};
    } catch (const nlohmann::json::exception& problem) {
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' gives no figures: {}", program.string(), problem.what()));
    }
}

}  // namespace verify
