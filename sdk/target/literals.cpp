#include "candela/target/literals.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "valid_utf8.h"

namespace candela::target {

namespace {

std::string replace_all(std::string text, std::string_view from, std::string_view to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}

}  // namespace

std::string float_text(float x) {
    std::string text = fmt::format("{}", x);
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return text + "f";
}

std::string vec3_text(Vec3 v) {
    if (v.x == v.y && v.y == v.z) return fmt::format("vec3({})", float_text(v.x));
    return fmt::format("vec3({}, {}, {})", float_text(v.x), float_text(v.y), float_text(v.z));
}

std::array<Vec3, 3> columns_of(const ParamValue& runtime) {
    const float* const m = runtime.number;
    return {{{m[0], m[3], m[6]}, {m[1], m[4], m[7]}, {m[2], m[5], m[8]}}};
}

std::string member_text(const ParamSpec& parameter, const ParamValue& runtime) {
    switch (parameter.type) {
        case ParamType::real:
            return float_text(runtime.number[0]);
        case ParamType::choice:
            return fmt::format(
                "{} /* {} */", runtime.integer,
                ascii_identifier(parameter.choices[static_cast<std::size_t>(runtime.integer)]));
        case ParamType::integer:
        case ParamType::boolean:
            return fmt::format("{}", runtime.integer);
        case ParamType::matrix: {
            const auto columns = columns_of(runtime);
            return fmt::format("mat3({}, {}, {})", vec3_text(columns[0]), vec3_text(columns[1]),
                               vec3_text(columns[2]));
        }
        case ParamType::file:
        case ParamType::numbers:
            return fmt::format("Table{{{}, {}}}", runtime.integer, runtime.list.size());
        default:
            return vec3_text({runtime.number[0], runtime.number[1], runtime.number[2]});
    }
}

double shortest(float x) {
    return std::isfinite(x) ? std::stod(fmt::format("{}", x)) : static_cast<double>(x);
}

std::string identifier(std::string_view name, std::string_view suffix) {
    std::string result = fmt::format("{}_{}", name, suffix);
    std::ranges::replace(result, '-', '_');
    return result;
}

std::string html_text(std::string_view text) {
    std::string result = replace_all(valid_utf8(text), "&", "&amp;");
    result = replace_all(result, "<", "&lt;");
    result = replace_all(result, ">", "&gt;");
    return replace_all(replace_all(result, "\"", "&quot;"), "'", "&#39;");
}

std::string script_json(std::string json) { return replace_all(std::move(json), "<", "\\u003c"); }

}  // namespace candela::target
