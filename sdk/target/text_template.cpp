#include "candela/target/text_template.h"

#include <algorithm>
#include <stdexcept>

namespace candela::target {

ValueViews views_of(const Values& values) { return {values.begin(), values.end()}; }

std::string filled(std::string_view text, const ValueViews& values) {
    const auto is_name = [](char c) { return (c >= 'A' && c <= 'Z') || c == '_'; };
    std::vector<std::string_view> parts;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t begin = std::min(text.find('@', at), text.size());
        parts.push_back(text.substr(at, begin - at));
        std::size_t end = begin + 1;
        while (end < text.size() && is_name(text[end])) ++end;
        if (begin == text.size() || end == begin + 1 || end >= text.size() || text[end] != '@') {
            if (begin < text.size()) parts.push_back(text.substr(begin, 1));
            at = begin + 1;
            continue;
        }
        const std::string_view name = text.substr(begin + 1, end - begin - 1);
        const auto value = std::ranges::find(values, name, &ValueViews::value_type::first);
        if (value == values.end())
            throw std::logic_error("a template has a placeholder without a value: " + std::string(name));
        parts.push_back(value->second);
        at = end + 1;
        const bool is_whole_line =
            (begin == 0 || text[begin - 1] == '\n') && at < text.size() && text[at] == '\n';
        const bool ends_line = value->second.empty() || value->second.back() == '\n';
        if (is_whole_line && ends_line) ++at;
    }
    std::size_t size = 0;
    for (const std::string_view part : parts) size += part.size();
    std::string result;
    result.reserve(size);
    for (const std::string_view part : parts) result += part;
    return result;
}

}  // namespace candela::target
