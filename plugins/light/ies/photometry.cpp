#include "photometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace candela::ies_light {

namespace {

constexpr std::uintmax_t k_most_bytes = 16 << 20;
constexpr std::size_t k_most_angles = 3601;    // steps of a tenth of a degree
constexpr std::size_t k_most_values = 500000;  // half a degree in both directions, and more
constexpr int k_most_steps = 720;
constexpr double k_brightest = 1e12;  // stays finite at any distance

constexpr std::string_view k_blanks = " \t\r,\f\v\x1a";

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(k_blanks);
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(k_blanks) - first + 1);
}

/// A file's beginning in messages: printable, and short.
std::string shown(std::string_view word) {
    constexpr std::size_t k_longest = 40;
    std::string result(word.substr(0, k_longest));
    for (char& c : result) {
        if (c < ' ' || c > '~') c = '?';
    }
    return word.size() > k_longest ? result + "..." : result;
}

/// The lines of a file, and the numbers in them.
class Reader {
  public:
    explicit Reader(const char* path) : path_(path) {
        std::error_code problem;
        if (!std::filesystem::is_regular_file(path, problem))
            throw std::runtime_error(fmt::format("'{}' is not a file", path));
        if (const auto size = std::filesystem::file_size(path, problem); size > k_most_bytes)
            throw std::runtime_error(
                fmt::format("'{}' has {} bytes; expected at most {}", path, size, k_most_bytes));
        std::ifstream file(path, std::ios::binary);
        content_.assign(std::istreambuf_iterator<char>(file), {});
        if (!file) throw std::runtime_error(fmt::format("'{}' cannot be read", path));
        rest_ = content_;
        if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);
    }

    /// The next line, without the blanks around it; false at the end of the file.
    bool next_line(std::string_view& line) {
        if (rest_.empty()) return false;
        const std::size_t end = rest_.find('\n');
        line = trimmed(rest_.substr(0, end));
        rest_.remove_prefix(end == rest_.npos ? rest_.size() : end + 1);
        ++line_;
        return true;
    }

    /// The next number. `what` it is, in messages.
    double number(std::string_view what) {
        const std::string_view word = next_word(what);
        const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
        double value = 0;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value))
            fail(fmt::format("'{}' is not a number; expected {}", shown(word), what));
        return value;
    }

    std::size_t count(std::string_view what, std::size_t most) {
        const double value = number(what);
        if (!(value >= 1 && value <= static_cast<double>(most)) || value != std::floor(value))
            fail(fmt::format("{} is {:g}; expected 1 to {}", what, value, most));
        return static_cast<std::size_t>(value);
    }

    double factor(std::string_view what) {
        const double value = number(what);
        if (!(value > 0)) fail(fmt::format("{} is {:g}; expected a positive number", what, value));
        return value;
    }

    void skip(std::size_t numbers, std::string_view what) {
        for (std::size_t i = 0; i < numbers; ++i) number(what);
    }

    [[noreturn]] void fail(std::string_view message) const {
        throw std::runtime_error(fmt::format("{}:{}: {}", path_, std::max<std::size_t>(line_, 1), message));
    }

  private:
    std::string_view next_word(std::string_view what) {
        while (words_.empty()) {
            if (!next_line(words_)) fail(fmt::format("the file ends here; expected {}", what));
        }
        const std::size_t end = std::min(words_.find_first_of(k_blanks), words_.size());
        const std::string_view word = words_.substr(0, end);
        words_ = trimmed(words_.substr(end));
        return word;
    }

    const char* path_;
    std::string content_;
    std::string_view rest_, words_;
    std::size_t line_ = 0;
};

std::vector<float> angles(Reader& reader, std::size_t count, double most, std::string_view what) {
    std::vector<float> result;
    for (std::size_t i = 0; i < count; ++i) {
        const auto angle = static_cast<float>(reader.number(what));
        if (!(angle >= 0 && angle <= static_cast<float>(most)))
            reader.fail(fmt::format("{} is {:g}; expected 0 to {:g} degrees", what, angle, most));
        if (!result.empty() && angle <= result.back())
            reader.fail(
                fmt::format("{} is {:g}, after {:g}; expected ascending ones", what, angle, result.back()));
        result.push_back(angle);
    }
    return result;
}

/// Whether the horizontal angles are all, or symmetry fills in the others.
bool are_complete(std::span<const float> horizontal) {
    const float first = horizontal.front(), last = horizontal.back();
    if (horizontal.size() == 1 || (first == 90 && last == 270)) return true;
    return first == 0 && (last == 90 || last >= 180);
}

/// Before 1995, a third factor stands where later versions have a number without a meaning.
bool has_photometric_factor(std::string_view first_line) {
    for (const std::string_view later : {"IESNA:LM-63-1995", "IESNA:LM-63-2002", "IES:LM-63"}) {
        if (first_line.starts_with(later)) return false;
    }
    return true;
}

/// The number of the largest equal steps of `range` degrees that meet all angles counted from `first`; at
/// most k_most_steps.
int steps_that_meet(std::span<const float> angles, float first, float range) {
    int step = static_cast<int>(std::lround(100 * range));
    for (const float angle : angles)
        step = std::gcd(step, static_cast<int>(std::lround(100 * (angle - first))));
    return step == 0 ? 0 : std::min(static_cast<int>(std::lround(100 * range)) / step, k_most_steps);
}

/// The interval that an angle lies in, and where.
std::pair<std::size_t, float> between(std::span<const float> angles, float angle) {
    if (angles.size() < 2) return {0, 0.0f};
    const auto above = std::upper_bound(angles.begin() + 1, angles.end() - 1, angle);
    const auto i = static_cast<std::size_t>(above - angles.begin()) - 1;
    return {i, std::clamp((angle - angles[i]) / (angles[i + 1] - angles[i]), 0.0f, 1.0f)};
}

/// The measured horizontal angle whose light symmetry also sends to this one, from 0 to 360.
float measured(const Photometry& photometry, float angle) {
    const float first = photometry.horizontal.front(), last = photometry.horizontal.back();
    if (first == 90) return angle < 90 ? 180 - angle : angle > 270 ? 540 - angle : angle;
    if (last <= 180 && angle > 180) angle = 360 - angle;
    return last <= 90 && angle > 90 ? 180 - angle : angle;
}

}  // namespace

Photometry read_photometry(const char* path) {
    Reader reader(path);
    std::string_view line, first_line;
    bool is_first = true;
    do {
        if (!reader.next_line(line))
            reader.fail(
                "the file ends here; expected a line 'TILT=NONE', as in photometric files (IES LM-63)");
        if (std::exchange(is_first, false)) first_line = line;
    } while (!line.starts_with("TILT="));
    if (line == "TILT=INCLUDE") {
        reader.number("the lamp's position in the luminaire");
        const std::size_t pairs = reader.count("the number of tilt angles", k_most_angles);
        reader.skip(pairs, "a tilt angle");
        reader.skip(pairs, "the factor for a tilt angle");
    }

    reader.skip(2, "the number of lamps and their lumens");
    double scale = reader.factor("the multiplier of candela values");
    const std::size_t columns = reader.count("the number of vertical angles", k_most_angles);
    const std::size_t rows = reader.count("the number of horizontal angles", k_most_angles);
    if (columns * rows > k_most_values)
        reader.fail(fmt::format("{} x {} angles are too many; expected at most {} candela values", columns,
                                rows, k_most_values));
    const double type = reader.number("the photometric type");
    if (type == 2 || type == 3)
        reader.fail(
            fmt::format("the photometry is of type {}; expected type C, which is 1", type == 2 ? 'B' : 'A'));
    if (type != 1) reader.fail(fmt::format("the photometric type is {:g}; expected 1, type C", type));
    reader.skip(4, "the unit of length, and the luminaire's width, length and height");
    scale *= reader.factor("the ballast factor");
    const double third = reader.number("the factor after the ballast factor");
    if (has_photometric_factor(first_line)) {
        if (!(third > 0))
            reader.fail(fmt::format("the photometric factor is {:g}; expected a positive number", third));
        scale *= third;
    }
    reader.skip(1, "the input watts");

    Photometry result;
    result.vertical = angles(reader, columns, 180, "a vertical angle");
    result.horizontal = angles(reader, rows, 360, "a horizontal angle");
    if (!are_complete(result.horizontal))
        reader.fail(
            fmt::format("the horizontal angles are {:g} to {:g}; expected 0 alone, or 0 to 90, 180 or 360",
                        result.horizontal.front(), result.horizontal.back()));
    for (std::size_t i = 0; i < columns * rows; ++i) {
        const double candela = reader.number(fmt::format("candela value {} of {}", i + 1, columns * rows));
        if (!(candela >= 0 && candela * scale <= k_brightest))
            reader.fail(fmt::format("candela value {} is {:g}, times {:g}; expected 0 to {:g}", i + 1,
                                    candela, scale, k_brightest));
        result.candela.push_back(static_cast<float>(candela * scale));
    }
    return result;
}

std::vector<float> table_of(const Photometry& photometry) {
    const std::span<const float> vertical = photometry.vertical;
    std::vector<float> horizontal = photometry.horizontal;
    // Without the angle that closes the circle, the first row follows the last.
    if (horizontal.size() > 1 && horizontal.front() == 0 && horizontal.back() > 180 &&
        horizontal.back() < 360)
        horizontal.push_back(360);
    const float first = vertical.front(), range = vertical.back() - first;
    const int down = steps_that_meet(vertical, first, range);
    const int around = horizontal.size() == 1 ? 0 : steps_that_meet(horizontal, 0, 360);
    std::vector<float> table = {static_cast<float>(down + 1), static_cast<float>(around + 1), first,
                                vertical.back()};
    for (int row = 0; row <= around; ++row) {
        const float angle = 360 * static_cast<float>(row) / static_cast<float>(std::max(around, 1));
        const auto [j, h] = between(horizontal, measured(photometry, angle));
        for (int column = 0; column <= down; ++column) {
            const auto [i, v] = between(
                vertical, first + range * static_cast<float>(column) / static_cast<float>(std::max(down, 1)));
            const auto candela = [&, i = i, v = v](std::size_t of_row) {
                const float* const values =
                    &photometry.candela[of_row % photometry.horizontal.size() * vertical.size()];
                return std::lerp(values[i], values[std::min(i + 1, vertical.size() - 1)], v);
            };
            table.push_back(std::lerp(candela(j), candela(j + 1), h));
        }
    }
    return table;
}

}  // namespace candela::ies_light
