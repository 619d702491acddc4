#include "commands/variants.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <set>

import candela.util;

namespace po = boost::program_options;
using candela::Error;
using candela::ErrorCategory;

namespace {

constexpr const char* k_terms = "terms";

/// Splits at commas outside brackets and quotes.
std::vector<std::string> split(const std::string& list) {
    std::vector<std::string> parts(1);
    int depth = 0;
    char quote = '\0';
    for (const char c : list) {
        if (quote != '\0') {
            if (c == quote) quote = '\0';
        } else if (c == '"' || c == '\'') {
            quote = c;
        } else if (c == '[' || c == '{') {
            ++depth;
        } else if (c == ']' || c == '}') {
            --depth;
        } else if (c == ',' && depth == 0) {
            parts.emplace_back();
            continue;
        }
        parts.back() += c;
    }
    return parts;
}

Axis axis_from(const std::string& option, const std::string& list, const std::string& label_before) {
    Axis axis;
    for (const std::string& value : split(list)) {
        if (value.empty())
            throw Error(ErrorCategory::bad_request,
                        fmt::format("{}: a value is missing in '{}'", option, list));
        if (std::ranges::find(axis, value, &Variant::value) != axis.end())
            throw Error(ErrorCategory::bad_request, fmt::format("{}: '{}' is repeated", option, value));
        axis.push_back({label_before + value, option, value});
    }
    return axis;
}

}  // namespace

void add_variant_options(CommandLine& line) {
    line.options()("vary", po::value<std::vector<std::string>>()->value_name("PATH=V1,V2,..."),
                   "values of one parameter, such as light.lamp.intensity=1,3; can "
                   "be repeated")("terms", po::value<std::string>()->value_name("TERM,..."),
                                  "the term that each picture shows: picture (the whole), diffuse, specular, "
                                  "normal, depth, light.NAME ... (docs/user/explaining.md)");
}

std::vector<Axis> axes_from(const CommandLine& line) {
    std::vector<Axis> axes;
    for (const char* const models : {"reflection", "shading"}) {
        if (line.has(models))
            axes.push_back(axis_from(fmt::format("--{}", models), line.get<std::string>(models), ""));
    }
    std::set<std::string> paths;
    for (const candela::Setting& setting : settings_from(line, "vary")) {
        const std::string flag = setting.path.substr(0, setting.path.find('.'));
        const bool is_model = setting.path == "reflection.model" || setting.path == "shading.model";
        if (!paths.insert(setting.path).second)
            throw Error(ErrorCategory::bad_request, fmt::format("--vary {} is repeated", setting.path));
        if (is_model && line.has(flag)) {
            throw Error(
                ErrorCategory::bad_request,
                fmt::format("--vary {} and --{} set the same value; use one of them", setting.path, flag));
        }
        axes.push_back(axis_from(setting.path, setting.value, setting.path + "="));
    }
    if (line.has(k_terms)) axes.push_back(axis_from("--terms", line.get<std::string>(k_terms), ""));
    if (std::ranges::count_if(axes, [](const Axis& axis) { return axis.size() > 1; }) > 2) {
        throw Error(
            ErrorCategory::bad_request,
            "a sheet has two axes: at most two of --reflection, --shading, --vary and --terms can have "
            "several values");
    }
    return axes;
}

std::vector<std::vector<Variant>> combinations(const std::vector<Axis>& axes) {
    std::vector<std::vector<Variant>> all(1);
    for (const Axis& axis : axes) {
        std::vector<std::vector<Variant>> longer;
        for (const Variant& variant : axis) {
            for (std::vector<Variant> before : all) {
                before.push_back(variant);
                longer.push_back(std::move(before));
            }
        }
        all = std::move(longer);
    }
    return all;
}

candela::SceneRequest varied(candela::SceneRequest request, const std::vector<Variant>& variants) {
    for (const Variant& variant : variants) {
        if (variant.option == "--reflection") {
            request.reflection = {variant.value, variant.option};
        } else if (variant.option == "--shading") {
            request.shading = {variant.value, variant.option};
        } else if (variant.option != "--terms") {
            request.settings.push_back({"--vary " + variant.option, variant.option, variant.value});
        }
    }
    return request;
}

std::string label_of(const std::vector<Axis>& axes, const std::vector<Variant>& variants) {
    std::string label;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        if (axes[i].size() > 1) label += (label.empty() ? "" : ", ") + variants[i].label;
    }
    return label;
}
