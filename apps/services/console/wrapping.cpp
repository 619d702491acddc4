#include "console/wrapping.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string>

import candela.util;

namespace {

std::size_t wanted_width() {
    const char* const columns = std::getenv("COLUMNS");
    const int number = columns != nullptr ? std::atoi(columns) : 0;
    if (number > 0) return static_cast<std::size_t>(number);
    winsize size{};
    if (::isatty(STDOUT_FILENO) == 1 && ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
        return size.ws_col;
    return 80;
}

/// Ends the paragraph collected so far.
void flush(std::string& paragraph, std::string& result, std::size_t width) {
    if (!paragraph.empty()) result += wrapped(paragraph, 0, 0, width) + '\n';
    paragraph.clear();
}

}  // namespace

std::size_t output_width() {
    constexpr std::size_t k_narrowest = 40;
    return std::max(wanted_width(), k_narrowest);
}

std::string wrapped(std::string_view text, std::size_t begin, std::size_t indent, std::size_t width) {
    std::string result;
    std::size_t column = begin;
    bool is_first = true;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        const std::string_view word = text.substr(0, end);
        const std::size_t size = candela::character_count(word);
        if (is_first) {
            column += size;
        } else if (column + 1 + size <= width) {
            result += ' ';
            column += 1 + size;
        } else {
            result += '\n' + std::string(indent, ' ');
            column = indent + size;
        }
        is_first = false;
        result += word;
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return result;
}

std::string row(std::string_view left, std::string_view right, std::size_t left_width, std::size_t margin,
                std::size_t width) {
    const std::size_t indent = margin + left_width + 1;
    const std::size_t taken = candela::character_count(left);
    std::string result = std::string(margin, ' ') + std::string(left);
    if (right.empty()) return result + '\n';
    result.append(taken < left_width ? left_width - taken + 1 : 1, ' ');
    return result + wrapped(right, std::max(indent, margin + taken + 1), indent, width) + '\n';
}

std::string wrapped_paragraphs(std::string_view text, std::size_t width) {
    std::string result;
    std::string paragraph;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const std::size_t margin = std::min(line.find_first_not_of(' '), line.size());
        if (margin == 0 && !line.empty()) {
            paragraph += (paragraph.empty() ? "" : " ") + std::string(line);
            continue;
        }
        flush(paragraph, result, width);
        const std::size_t gap = line.find("  ", margin);
        if (line.empty()) {
            result += '\n';
        } else if (gap == std::string_view::npos) {
            result += row(line.substr(margin), "", 0, margin, width);
        } else {
            const std::size_t right = std::min(line.find_first_not_of(' ', gap), line.size());
            result +=
                row(line.substr(margin, gap - margin), line.substr(right), right - margin - 1, margin, width);
        }
    }
    flush(paragraph, result, width);
    return result;
}
