#include "film/frame_pattern.h"

#include <fmt/format.h>

#include <charconv>
#include <cstddef>
#include <string_view>
#include <system_error>

import candela.util;

using candela::Error;
using candela::ErrorCategory;

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

[[noreturn]] void reject(const std::string& message) { throw Error(ErrorCategory::bad_request, message); }

/// "frames.png" with a placeholder for the number.
std::string with_place(const std::filesystem::path& file) {
    return (file.parent_path() / (file.stem().string() + "%04d" + file.extension().string())).string();
}

std::optional<int> number_from(std::string_view text) {
    int number = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (problem != std::errc() || end != text.data() + text.size() || text.starts_with('-'))
        return std::nullopt;
    return number;
}

}  // namespace

FramePattern::FramePattern(const std::string& pattern) : text_(pattern) {
    if (pattern == "-") reject("frames cannot be written to standard output; use -o frames/%04d.png");
    constexpr int k_most_digits = 20;
    bool is_found = false;
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        std::string& part = is_found ? after_ : before_;
        if (pattern[i] != '%') {
            part += pattern[i];
            continue;
        }
        if (pattern.compare(i, 2, "%%") == 0) {
            part += '%';
            ++i;
            continue;
        }
        std::size_t end = i + 1;
        while (end < pattern.size() && is_digit(pattern[end])) ++end;
        const std::string_view width = std::string_view(pattern).substr(i + 1, end - i - 1);
        const bool is_plain = width.empty() || (width.size() <= 3 && width.front() == '0');
        if (end == pattern.size() || pattern[end] != 'd' || !is_plain) {
            reject(fmt::format(
                "'{}' in '{}' is not a placeholder for a frame's number; use %04d, or %% for a percent sign",
                pattern.substr(i, end - i + 1), pattern));
        }
        if (is_found)
            reject(fmt::format("'{}' has more than one placeholder for a frame's number; expected one",
                               pattern));
        is_found = true;
        digits_ = number_from(width).value_or(0);
        if (digits_ > k_most_digits)
            reject(
                fmt::format("'{}' asks for {} digits; the maximum is {}", pattern, digits_, k_most_digits));
        i = end;
    }
    if (!is_found) {
        reject(fmt::format("'{}' names one file for all frames; expected a placeholder for their numbers: {}",
                           pattern, with_place(pattern)));
    }
    if (after_.find('/') != std::string::npos)
        reject(fmt::format("'{}' has the frame's number in a folder name; expected it in the file name",
                           pattern));
}

std::filesystem::path FramePattern::file_of(int frame) const {
    return fmt::format("{}{:0{}}{}", before_, frame, digits_, after_);
}

std::string escaped_for_pattern(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '%') result += '%';
        result += c;
    }
    return result;
}

std::vector<int> frames_from(const std::optional<std::string>& range, int step, int count) {
    if (step < 1) reject(fmt::format("--step is {}; expected at least 1", step));
    int first = 0, last = count - 1;
    if (range) {
        const std::size_t dots = range->find("..");
        const auto from = number_from(std::string_view(*range).substr(0, dots));
        const auto to =
            dots == std::string::npos ? from : number_from(std::string_view(*range).substr(dots + 2));
        if (!from || !to)
            reject(fmt::format("--frames is '{}'; expected a frame or a range such as 10..200", *range));
        if (*to < *from)
            reject(fmt::format("--frames {} is empty: {} is greater than {}", *range, *from, *to));
        if (*to > last)
            reject(fmt::format("--frames {}: frame {} does not exist; the animation has frames 0 to {}",
                               *range, *to, last));
        first = *from;
        last = *to;
    }
    std::vector<int> frames;
    for (int frame = first; frame <= last; frame += step) {
        frames.push_back(frame);
        if (step > last - frame) break;
    }
    return frames;
}
