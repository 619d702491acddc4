#include "viewer/page.h"

#include <cstddef>
#include <utility>

namespace view {

namespace {

/// The value of `id="..."` in a tag; empty if it has none.
std::string_view id_in(std::string_view tag) {
    constexpr std::string_view k_name = " id=\"";
    const std::size_t name = tag.find(k_name);
    if (name == std::string_view::npos) return {};
    const std::string_view value = tag.substr(name + k_name.size());
    return value.substr(0, value.find('"'));
}

}  // namespace

Page::Page(std::string html) : html_(std::move(html)) {
    constexpr std::string_view k_begin = "<script", k_end = "</script>";
    std::string_view rest = html_;
    for (std::size_t at = rest.find(k_begin); at != std::string_view::npos; at = rest.find(k_begin)) {
        rest.remove_prefix(at);
        const std::size_t content = rest.find('>');
        const std::size_t end = rest.find(k_end, content);
        if (content == std::string_view::npos || end == std::string_view::npos) return;
        const std::string_view id = id_in(rest.substr(0, content));
        if (!id.empty()) parts_.emplace(id, rest.substr(content + 1, end - content - 1));
        rest.remove_prefix(end + k_end.size());
    }
}

std::optional<std::string_view> Page::part(std::string_view id) const {
    const auto found = parts_.find(id);
    return found == parts_.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace view
