module;

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

module candela.plugins;

import candela.util;

namespace candela {

namespace {

using namespace std::string_view_literals;

struct Magic {
    std::string_view extension;
    std::string_view begin;
    std::string_view further = {};  // and this,
    std::size_t at = 0;             // at this offset
};

constexpr std::array k_magics = {
    Magic{"png", "\x89PNG\r\n\x1a\n"sv},
    Magic{"jpg", "\xff\xd8\xff"sv},
    Magic{"tif", "II*\0"sv},
    Magic{"tif", "MM\0*"sv},
    Magic{"tif", "II+\0"sv},
    Magic{"tif", "MM\0+"sv},
    Magic{"exr", "\x76\x2f\x31\x01"sv},
    Magic{"hdr", "#?RADIANCE"sv},
    Magic{"hdr", "#?RGBE"sv},
    Magic{"webp", "RIFF"sv, "WEBP"sv, 8},
    Magic{"bmp", "BM"sv, "\0\0\0\0"sv, 6},  // reserved
    Magic{"gif", "GIF8"sv},
    Magic{"dds", "DDS "sv},
    Magic{"psd", "8BPS"sv},
    Magic{"ktx2", "\xabKTX 20\xbb"sv},
    Magic{"jp2", "\0\0\0\x0cjP  "sv},
    Magic{"avif", "\0\0\0"sv, "ftypavif"sv, 4},
    Magic{"heic", "\0\0\0"sv, "ftypheic"sv, 4},
};

/// "P6" and the like, followed by white space.
std::string_view netpbm_format(std::string_view head) noexcept {
    if (head.size() < 3 || head[0] != 'P' || " \t\r\n"sv.find(head[2]) == std::string_view::npos) return {};
    if (head[1] == 'F' || head[1] == 'f') return "pfm";
    if (head[1] == '6') return "ppm";
    return head[1] >= '1' && head[1] <= '5' ? "pnm" : "";
}

constexpr std::array<std::array<std::string_view, 4>, 3> k_families = {
    {{"jpg", "jpeg", "jpe", "jfif"}, {"tif", "tiff", "tif", "tiff"}, {"ppm", "pnm", "pgm", "pbm"}}};

}  // namespace

std::string_view format_by_content(std::string_view head) noexcept {
    for (const Magic& magic : k_magics)
        if (head.starts_with(magic.begin) && head.size() >= magic.at &&
            head.substr(magic.at).starts_with(magic.further))
            return magic.extension;
    return netpbm_format(head);
}

std::string_view format_of_content(const std::filesystem::path& file) {
    constexpr std::size_t k_head = 32;
    const auto head = read_text_file(file, k_head);
    return head ? format_by_content(std::string_view(*head)) : std::string_view();
}

bool are_one_format(std::string_view a, std::string_view b) noexcept {
    if (a == b) return true;
    for (const auto& family : k_families) {
        bool has_a = false, has_b = false;
        for (const std::string_view extension : family) {
            has_a = has_a || extension == a;
            has_b = has_b || extension == b;
        }
        if (has_a && has_b) return true;
    }
    return false;
}

const PluginFile* reader_of(const std::filesystem::path& file, Registry& registry) {
    const std::string by_name = extension_of(file);
    const std::string_view by_content = format_of_content(file);
    if (!by_content.empty() && !are_one_format(by_content, by_name))
        if (const PluginFile* const plugin = registry.find_format(by_content, FormatUse::read)) return plugin;
    return registry.find_format(by_name, FormatUse::read);
}

}  // namespace candela
