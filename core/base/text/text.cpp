module;

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

module candela.text;

namespace candela {

std::string shortened(std::string_view text) {
    constexpr std::size_t k_longest = 40;
    std::string result(text.substr(0, k_longest));
    // Do not cut a character in half.
    while (text.size() > k_longest && !result.empty() &&
           (static_cast<unsigned char>(text[result.size()]) & 0xc0) == 0x80) {
        result.pop_back();
    }
    for (char& c : result) {
        if (static_cast<unsigned char>(c) < 0x20) c = ' ';
    }
    return result.size() < text.size() ? result + "..." : result;
}

std::string size_text(std::uint64_t bytes) {
    constexpr std::array k_units = {"bytes", "kB", "MB", "GB", "TB", "PB", "EB"};
    auto size = static_cast<double>(bytes);
    std::size_t unit = 0;
    for (; size >= 999.95 && unit + 1 < k_units.size(); ++unit) size /= 1000;
    return unit == 0 ? fmt::format("{} bytes", bytes) : fmt::format("{:.1f} {}", size, k_units[unit]);
}

}  // namespace candela
