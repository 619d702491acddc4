#include "page_arrays.h"

#include <fmt/format.h>

#include <functional>

#include "candela/target/literals.h"

namespace candela::webgl_target {

std::string PageArrays::put(std::span<const std::byte> bytes) {
    const std::string_view characters(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::string text = target::base64(bytes);
    std::string name =
        fmt::format("array-{:x}-{:016x}", bytes.size(), std::hash<std::string_view>{}(characters));
    for (auto found = places_.find(name); found != places_.end(); found = places_.find(name)) {
        const auto [begin, size] = found->second;
        if (std::string_view(html_).substr(begin, size) == text) return name;
        name += "-other";
    }
    html_ += fmt::format("<script type=\"text/plain\" id=\"{}\">", name);
    places_[name] = {html_.size(), text.size()};
    html_ += text;
    html_ += "</script>\n";
    return names_.emplace_back(std::move(name));
}

}  // namespace candela::webgl_target
