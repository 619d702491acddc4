module;

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

module candela.plugins;

namespace candela {

namespace {

constexpr std::string_view k_others = "openimageio";

/// Whether the plugin is missing even as a file that was refused; installing a package would not help with a
/// refused one.
bool is_missing(Registry& registry) {
    if (registry.find(PluginKind::image, k_others) != nullptr) return false;
    return std::ranges::none_of(registry.refusals(), [](const Refusal& refusal) {
        return refusal.file.stem().string() == fmt::format("image-{}", k_others);
    });
}

}  // namespace

std::string possible_formats(Registry& registry, FormatUse use) {
    return fmt::format(" (possible: {}){}", fmt::join(registry.extensions(use), ", "),
                       is_missing(registry) ? "; install candela-openimageio for EXR, TIFF and others" : "");
}

}  // namespace candela
