#include "subject.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <variant>

#include "candela/kernel_language/declarations.h"

import candela.api;
import candela.plugins;

namespace kl = candela::kernel_language;
using candela::Parameter;
using candela::ParamType;
using candela::Vec3;

namespace {

std::filesystem::path& library_path() {
    static std::filesystem::path path;
    return path;
}

GivenValues& given_values() {
    static GivenValues given;
    return given;
}

Vec3 three(double x) {
    const auto f = static_cast<float>(x);
    return {f, f, f};
}

/// The numbers in a text: one, or [three].
std::vector<double> numbers_in(const std::string& text) {
    std::array<double, 3> v{};
    int end = -1;
    const auto is_all = [&] { return static_cast<std::size_t>(end) == text.size(); };
    if (std::sscanf(text.c_str(), "%lf%n", &v[0], &end) == 1 && is_all()) return {v[0]};
    if (std::sscanf(text.c_str(), " [ %lf , %lf , %lf ]%n", &v[0], &v[1], &v[2], &end) == 3 && is_all())
        return {v[0], v[1], v[2]};
    return {};
}

/// All numbers of a text, whatever its brackets and commas; none if it contains anything else.
std::vector<float> all_numbers_in(std::string text) {
    std::ranges::replace_if(text, [](char c) { return c == '[' || c == ']' || c == ','; }, ' ');
    std::istringstream in(text);
    std::vector<float> numbers{std::istream_iterator<float>(in), {}};
    if (!in.eof()) numbers.clear();
    return numbers;
}

/// Converts a text to a value of a parameter's type. Throws std::invalid_argument if that is impossible.
candela::Value value_from(const Parameter& p, const std::string& text) {
    const std::vector<double> numbers = numbers_in(text);
    const auto require = [&](bool is_one) {
        if (is_one) return;
        throw std::invalid_argument(
            fmt::format("'{}' is not a value for '{}': {}", text, p.name, candela::constraint_text(p)));
    };
    switch (p.type) {
        case ParamType::text:
        case ParamType::choice:
            return text;
        case ParamType::file:
            return std::filesystem::absolute(text).string();
        case ParamType::boolean:
            require(text == "true" || text == "false");
            return text == "true";
        case ParamType::integer:
            require(numbers.size() == 1);
            return std::int64_t{std::llround(numbers[0])};
        case ParamType::real:
            require(numbers.size() == 1);
            return numbers[0];
        case ParamType::matrix: {
            const std::vector<float> all = all_numbers_in(text);
            candela::Matrix rows{};
            require(all.size() == rows.size());
            std::ranges::copy(all, rows.begin());
            return rows;
        }
        case ParamType::numbers: {
            std::vector<float> all = all_numbers_in(text);
            require(!all.empty());
            return all;
        }
        default:
            break;
    }
    if (p.type == ParamType::rgb && numbers.size() == 1) return three(numbers[0]);
    require(numbers.size() == 3);
    return Vec3{static_cast<float>(numbers[0]), static_cast<float>(numbers[1]),
                static_cast<float>(numbers[2])};
}

bool is_fixed(const Parameter& p) {
    // Valid texts and files cannot be made up.
    return p.type == ParamType::text || p.type == ParamType::file || given_values().contains(p.name);
}

constexpr float k_far = 1000;  // stands in for an absent bound

struct Range {
    double low, high;
};

/// The least and the greatest number to test; excluded bounds are avoided by a thousandth of the range.
Range range_of(const Parameter& p) {
    if (p.type == ParamType::color) return {0, 255};
    const bool has_low = p.minimum != candela::k_no_minimum, has_high = p.maximum != candela::k_no_maximum;
    Range range{has_low ? p.minimum : (has_high ? p.maximum - k_far : -k_far),
                has_high ? p.maximum : (has_low ? p.minimum + k_far : k_far)};
    if (p.type == ParamType::point && !has_low) range = {-4, 4};
    if (p.type == ParamType::matrix && !has_low && !has_high) range = {-2, 2};
    const double hair = 1e-3 * std::min(range.high - range.low, 1.0);
    if (p.minimum_excluded) range.low += hair;
    if (p.maximum_excluded) range.high -= hair;
    // A few faces are enough to judge a shape.
    if (p.type == ParamType::integer) range.high = std::min(range.high, std::max(range.low, 64.0));
    return range;
}

/// The value at fraction `t` of the range, 0 to 1; `turn` makes the components of a vector differ.
candela::Value value_at(const Parameter& p, double t, const Vec3& turn) {
    const Range range = range_of(p);
    const auto at = [&](double share) { return range.low + share * (range.high - range.low); };
    switch (p.type) {
        case ParamType::real:
            return at(t);
        case ParamType::integer:
            if (!p.choices.empty()) {
                const auto last = static_cast<double>(p.choices.size() - 1);
                return std::int64_t{std::stoll(p.choices[static_cast<std::size_t>(std::lround(t * last))])};
            }
            return std::int64_t{std::llround(at(t))};
        case ParamType::boolean:
            return t >= 0.5;
        case ParamType::choice:
            return p.choices[static_cast<std::size_t>(
                std::lround(t * static_cast<double>(p.choices.size() - 1)))];
        case ParamType::text:
        case ParamType::file:
            return std::string();
        case ParamType::direction:
            return turn == Vec3{} ? Vec3{0, -1, 0} : turn;
        case ParamType::color:
            return three(std::round(at(t)));
        case ParamType::rgb:
            return three(at(t));
        case ParamType::matrix: {
            candela::Matrix rows{};
            for (std::size_t i = 0; i < rows.size(); ++i)
                rows[i] = static_cast<float>(at(std::fmod(t + 0.375 * static_cast<double>(i), 1.0)));
            return rows;
        }
        case ParamType::numbers: {
            // One number, or up to sixteen.
            candela::NumberList list;
            for (int i = 0; i <= static_cast<int>(15 * t); ++i)
                list.push_back(static_cast<float>(at(i % 2 == 0 ? t : 1 - t)));
            return list;
        }
        default: {
            const auto part = [&](float share) { return static_cast<float>(at(0.5 + 0.5 * double{share})); };
            return turn == Vec3{} ? three(at(t)) : Vec3{part(turn.x), part(turn.y), part(turn.z)};
        }
    }
}

bool is_allowed(const candela::ParamSet& set) {
    return std::ranges::none_of(subject_manifest().relations, [&](const candela::Relation& relation) {
        return !relation.only_warns && candela::validation_error(relation, set).has_value();
    });
}

Values named(candela::ParamSet set) {
    std::string text;
    for (std::size_t i = 0; i < set.schema().size(); ++i) {
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", set.schema()[i].name,
                            set.get(i) ? candela::text_of(*set.get(i)) : "?");
    }
    return {std::move(set), text.empty() ? "no parameters" : text};
}

template <class Interface>
std::unique_ptr<Interface> made(const Values& values) {
    if (needs_a_file()) SKIP("it needs a file that only a user has; --set NAME=FILE provides one");
    const auto runtime = values.set.runtime(candela::ColorEncoding::none);
    std::unique_ptr<candela::Instance> instance(subject().create(runtime));
    if (instance == nullptr) FAIL("create() returned nothing with " << values.text);
    auto* const typed = dynamic_cast<Interface*>(instance.get());
    if (typed == nullptr) FAIL("create() returned an object without the interface of its kind");
    static_cast<void>(instance.release());
    return std::unique_ptr<Interface>(typed);
}

}  // namespace

void set_subject(const std::filesystem::path& library, const GivenValues& given) {
    library_path() = library;
    given_values() = given;
}
const std::filesystem::path& subject_library() { return library_path(); }

const candela::Manifest& subject_manifest() {
    static const candela::Manifest manifest = [] {
        std::filesystem::path path = subject_library();
        std::ifstream in(path.replace_extension(".json"), std::ios::binary);
        if (!in) FAIL("its manifest '" << path.string() << "' cannot be read");
        try {
            return candela::manifest_from_json(std::string(std::istreambuf_iterator<char>(in), {}));
        } catch (const std::exception& problem) {
            FAIL("its manifest '" << path.string() << "' is invalid: " << problem.what());
            throw;
        }
    }();
    return manifest;
}

const candela::PluginDescriptor& subject() {
    static const candela::PluginDescriptor& descriptor = []() -> const candela::PluginDescriptor& {
        const candela::Manifest& manifest = subject_manifest();
        try {
            return candela::load_plugin(subject_library(), &manifest);
        } catch (const std::exception& problem) {
            FAIL(problem.what());
            throw;
        }
    }();
    return descriptor;
}

bool declares(const std::string& property) { return subject_manifest().property(property) == "true"; }
std::string declared(const std::string& property) {
    return subject_manifest().property(property).value_or("");
}

bool declares_for(const std::string& property, const Values& values) {
    const auto value = subject_manifest().property(property);
    if (!value) return false;
    try {
        return kl::hold(kl::conditions_of(*value), values.set);
    } catch (const std::invalid_argument&) {
        return true;  // "declarations" reports the problem
    }
}

Values default_values() {
    candela::ParamSet set(subject_manifest().parameters);
    for (const auto& [name, text] : given_values()) {
        const std::size_t index = set.index_of(name);
        if (index == set.schema().size())
            FAIL("--set " << name << "=" << text << ": it has no parameter '" << name << "'");
        try {
            set.set(name, value_from(set.schema()[index], text));
        } catch (const std::invalid_argument& problem) {
            FAIL("--set " << name << "=" << text << ": " << problem.what());
        }
    }
    for (std::size_t i = 0; i < set.schema().size(); ++i) {
        if (!set.get(i)) set.set(i, value_at(set.schema()[i], 0.5, {}));
    }
    return named(std::move(set));
}

std::vector<Values> many_values(int random_sets) {
    const Values defaults = default_values();
    std::vector<Values> all{defaults};
    const std::vector<Parameter>& schema = defaults.set.schema();
    for (std::size_t i = 0; i < schema.size(); ++i) {
        if (is_fixed(schema[i])) continue;
        for (const double t : {0.0, 1.0}) {
            candela::ParamSet set = defaults.set;
            set.set(i, value_at(schema[i], t, {}));
            if (is_allowed(set)) all.push_back(named(std::move(set)));
        }
    }
    if (std::ranges::all_of(schema, is_fixed)) return all;
    std::mt19937 random(1975);
    std::uniform_real_distribution<double> unit(0, 1);
    std::uniform_real_distribution<float> both(-1, 1);
    for (int tries = 0, found = 0; found < random_sets && tries < 100 * random_sets; ++tries) {
        candela::ParamSet set = defaults.set;
        for (std::size_t i = 0; i < schema.size(); ++i) {
            if (is_fixed(schema[i])) continue;
            set.set(i, value_at(schema[i], unit(random), {both(random), both(random), both(random)}));
        }
        if (!is_allowed(set)) continue;
        all.push_back(named(std::move(set)));
        ++found;
    }
    return all;
}

bool needs_a_file() {
    return std::ranges::any_of(subject_manifest().parameters, [](const Parameter& p) {
        return p.type == ParamType::file && !p.default_value && !given_values().contains(p.name);
    });
}

template <>
std::unique_ptr<candela::Light> make(const Values& values) {
    return made<candela::Light>(values);
}
template <>
std::unique_ptr<candela::ReflectionModel> make(const Values& values) {
    return made<candela::ReflectionModel>(values);
}
template <>
std::unique_ptr<candela::ShadingModel> make(const Values& values) {
    return made<candela::ShadingModel>(values);
}
template <>
std::unique_ptr<candela::Shape> make(const Values& values) {
    return made<candela::Shape>(values);
}
template <>
std::unique_ptr<candela::Target> make(const Values& values) {
    return made<candela::Target>(values);
}
template <>
std::unique_ptr<candela::ImageFormat> make(const Values& values) {
    return made<candela::ImageFormat>(values);
}
