#include "conditions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <variant>

namespace {

std::vector<std::string> words_of(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

std::optional<double> number_in(const std::string& text) {
    std::istringstream stream(text);
    double number = 0;
    if (!(stream >> number) || stream.peek() != std::istringstream::traits_type::eof()) return std::nullopt;
    return number;
}

std::optional<double> number_of(const candela::Value& value) {
    if (const auto* const real = std::get_if<double>(&value)) return *real;
    if (const auto* const integer = std::get_if<std::int64_t>(&value)) return static_cast<double>(*integer);
    return std::nullopt;
}

bool is_equal(const candela::Value& value, const std::string& text) {
    if (const auto* const word = std::get_if<std::string>(&value)) return *word == text;
    if (const auto number = number_of(value)) return number_in(text) == number;
    return candela::text_of(value) == text;
}

bool holds(const Condition& condition, const candela::ParamSet& values) {
    const std::size_t index = values.index_of(condition.parameter);
    if (index == values.schema().size() || !values.get(index)) return false;
    const candela::Value& value = *values.get(index);
    if (condition.kind == Condition::Kind::is_one_of) {
        return std::ranges::any_of(condition.values,
                                   [&](const std::string& text) { return is_equal(value, text); });
    }
    const auto actual = number_of(value), bound = number_in(condition.values.front());
    if (!actual || !bound) return false;
    return condition.kind == Condition::Kind::is_at_least ? *actual >= *bound : *actual <= *bound;
}

}  // namespace

std::vector<Condition> conditions_of(const std::string& property_value) {
    if (property_value == "true") return {};
    const auto malformed = [&] {
        return std::invalid_argument(fmt::format(
            R"('{}'; it is "true", or such as "where form is disc or ring and shininess is at least 1")",
            property_value));
    };
    const std::vector<std::string> words = words_of(property_value);
    std::size_t at = 0;
    const auto next = [&] {
        if (at == words.size()) throw malformed();
        return words[at++];
    };
    const auto skip = [&](const char* word) {
        if (at == words.size() || words[at] != word) return false;
        ++at;
        return true;
    };
    if (!skip("where")) throw malformed();
    std::vector<Condition> conditions;
    do {
        Condition& condition = conditions.emplace_back();
        condition.parameter = next();
        if (next() != "is") throw malformed();
        if (skip("at")) {
            const std::string bound = next();
            if (bound != "least" && bound != "most") throw malformed();
            condition.kind = bound == "least" ? Condition::Kind::is_at_least : Condition::Kind::is_at_most;
            condition.values.push_back(next());
            if (!number_in(condition.values.front())) throw malformed();
            continue;
        }
        do {
            condition.values.push_back(next());
        } while (skip("or"));
    } while (skip("and"));
    if (at != words.size()) throw malformed();
    return conditions;
}

bool hold(const std::vector<Condition>& conditions, const candela::ParamSet& values) {
    return std::ranges::all_of(conditions, [&](const Condition& c) { return holds(c, values); });
}

std::vector<std::string> names_in(const std::string& property_value) {
    std::vector<std::string> names;
    for (std::size_t begin = 0; begin <= property_value.size();) {
        const std::size_t comma = std::min(property_value.find(", ", begin), property_value.size());
        names.push_back(property_value.substr(begin, comma - begin));
        begin = comma + 2;
    }
    return names;
}
