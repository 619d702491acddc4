module;

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

module candela.util;

import :ascii;

namespace candela {

std::string shortened(std::string_view text) {
    constexpr std::size_t k_longest = 40;
    std::size_t size = 0;
    while (size < text.size()) {
        const std::size_t next = size + first_character(text.substr(size)).size();
        if (next > k_longest) break;
        size = next;
    }
    const std::string result(text.substr(0, size));
    return result.size() < text.size() ? result + "..." : result;
}

std::string extension_of(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    if (!extension.empty()) extension.erase(0, 1);
    std::ranges::transform(extension, extension.begin(), to_lower);
    return extension;
}

std::string size_text(std::uint64_t bytes) {
    constexpr std::array k_units = {"bytes", "kB", "MB", "GB", "TB", "PB", "EB"};
    auto size = static_cast<double>(bytes);
    std::size_t unit = 0;
    for (; size >= 999.95 && unit + 1 < k_units.size(); ++unit) size /= 1000;
    return unit == 0 ? fmt::format("{} bytes", bytes) : fmt::format("{:.1f} {}", size, k_units[unit]);
}

}  // namespace candela
