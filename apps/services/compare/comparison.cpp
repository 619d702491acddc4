#include "compare/comparison.h"

#include <fmt/format.h>

#include <optional>

#include "json/json.h"

namespace {

Json json_of(const DifferenceStatistics& statistics) {
    Json result = {{"pixels", statistics.pixels},
                   {"identical", statistics.identical},
                   {"maximum", statistics.maximum},
                   {"at", nullptr},
                   {"mean", statistics.mean},
                   {"rmse", statistics.rmse},
                   {"psnr", nullptr}};
    if (statistics.maximum > 0) result["at"] = {statistics.x, statistics.y};
    if (const auto psnr = statistics.psnr()) result["psnr"] = *psnr;
    return result;
}

DifferenceStatistics statistics_from(const Json& json) {
    DifferenceStatistics result{.pixels = json.at("pixels"),
                                .identical = json.at("identical"),
                                .maximum = json.at("maximum"),
                                .mean = json.at("mean"),
                                .rmse = json.at("rmse")};
    if (const Json& at = json.at("at"); !at.is_null()) {
        result.x = at.at(0);
        result.y = at.at(1);
    }
    return result;
}

}  // namespace

double Comparison::perceptible_share() const {
    return static_cast<double>(perceptible) / (static_cast<double>(width) * static_cast<double>(height));
}

std::string to_json(const Comparison& comparison) {
    const Differences& differences = comparison.differences;
    Json result = {{"width", comparison.width},
                   {"height", comparison.height},
                   {"interior", json_of(differences.interior)}};
    result["edges"] = differences.edges ? json_of(*differences.edges) : nullptr;
    result["perceptible"] = {{"pixels", comparison.perceptible}, {"share", comparison.perceptible_share()}};
    return json_text(result, 2);
}

Comparison comparison_from_json(const std::string& text) {
    try {
        const Json json = parse_json(text);
        Comparison result{.width = json.at("width"), .height = json.at("height")};
        result.differences.interior = statistics_from(json.at("interior"));
        if (const Json& edges = json.at("edges"); !edges.is_null())
            result.differences.edges = statistics_from(edges);
        result.perceptible = json.at("perceptible").at("pixels");
        return result;
    } catch (const Json::exception& problem) {
        throw candela::Error(candela::ErrorCategory::failure, problem.what());
    }
}
