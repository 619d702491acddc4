#include "text_template.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>

import candela.core;

using candela::Error;
using candela::ErrorCategory;

namespace generate {

std::string Templates::text(const std::string& name) const {
    const std::filesystem::path path = directory / name;
    std::ifstream in(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    if (!in || text.empty()) {
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}', which programs are generated from, cannot be read: {}", path.string(),
                                std::strerror(errno)));
    }
    return text;
}

std::string filled(const std::string& text, const Values& values) {
    const auto is_name = [](char c) { return (c >= 'A' && c <= 'Z') || c == '_'; };
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t begin = std::min(text.find('@', at), text.size());
        result.append(text, at, begin - at);
        std::size_t end = begin + 1;
        while (end < text.size() && is_name(text[end])) ++end;
        if (begin == text.size() || end == begin + 1 || end >= text.size() || text[end] != '@') {
            if (begin < text.size()) result += '@';
            at = begin + 1;
            continue;
        }
        const std::string name = text.substr(begin + 1, end - begin - 1);
        const auto value = std::ranges::find(values, name, &Values::value_type::first);
        if (value == values.end())
            throw std::logic_error("a template has a place that nothing fills: " + name);
        result += value->second;
        at = end + 1;
        const bool is_whole_line =
            (begin == 0 || text[begin - 1] == '\n') && at < text.size() && text[at] == '\n';
        const bool ends_line = value->second.empty() || value->second.back() == '\n';
        if (is_whole_line && ends_line) ++at;
    }
    return result;
}

}  // namespace generate
