#include "heat_map.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "compare/differences.h"

import candela.util;

namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

namespace {

/// Lossless formats, because a lossy one would show differences that do not exist; and only those whose
/// writers can write to memory.
const std::vector<std::string>& lossless_extensions() {
    static const std::vector<std::string> k_extensions = {"png", "ppm", "bmp", "tga"};
    return k_extensions;
}

/// Red, green and blue of each pixel.
std::vector<std::uint8_t> heat_colors(const Image& a, const Image& b, double maximum) {
    std::vector<float> heat(a.pixels());
    for (std::size_t i = 0; i < heat.size() && maximum > 0; ++i)
        heat[i] = static_cast<float>(largest_difference(a, b, i) / maximum);
    const OIIO::ImageBuf source(OIIO::ImageSpec(a.width, a.height, 1, OIIO::TypeFloat), heat.data());
    const OIIO::ImageBuf colored = OIIO::ImageBufAlgo::color_map(source, 0, "magma");
    std::vector<std::uint8_t> colors(3 * heat.size());
    if (colored.has_error() || !colored.get_pixels(colored.roi(), OIIO::TypeUInt8, colors.data()))
        throw Error(ErrorCategory::failure, fmt::format("cannot make a heat-map: {}", colored.geterror()));
    return colors;
}

std::vector<unsigned char> encoded(const std::string& extension, int width, int height,
                                   const std::vector<std::uint8_t>& colors) {
    const auto fail = [&](const std::string& reason) {
        throw Error(ErrorCategory::failure,
                    fmt::format("cannot write a heat-map as {}: {}", extension, reason));
    };
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("heat-map." + extension);
    if (output == nullptr) fail(OIIO::geterror());
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    OIIO::ImageSpec spec(width, height, 3, OIIO::TypeUInt8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("Software", "Candela");
    // If this is left out, some writers add the time of writing, so that no two files of one picture are the
    // same.
    spec.attribute("DateTime", "");
    if (!output->set_ioproxy(&memory) || !output->open("heat-map." + extension, spec) ||
        !output->write_image(OIIO::TypeUInt8, colors.data()) || !output->close()) {
        fail(output->geterror());
    }
    return bytes;
}

}  // namespace

void require_heat_map_format(const fs::path& file) {
    const std::string extension = candela::extension_of(file);
    if (std::ranges::find(lossless_extensions(), extension) != lossless_extensions().end()) return;
    const std::string meant =
        extension.empty() ? "" : candela::suggestion(extension, lossless_extensions(), ".");
    throw Error(ErrorCategory::bad_request,
                fmt::format("'{}' {}{} (possible: {})", file.string(),
                            extension.empty() ? "has no file extension of a picture format"
                                              : "has an unsupported heat-map format",
                            meant.empty() ? "" : "; " + meant, fmt::join(lossless_extensions(), ", ")));
}

void write_heat_map(const fs::path& file, const Image& a, const Image& b, double maximum,
                    candela::Existing existing) {
    // The heat, its colours in floats and in bytes, and the file.
    candela::require_memory(a.pixels() * (4 + 12 + 3 + 3), "the heat-map");
    const auto bytes = encoded(candela::extension_of(file), a.width, a.height, heat_colors(a, b, maximum));
    candela::OutputFile output(file, existing);
    output.write(std::as_bytes(std::span(bytes)));
    output.finish();
}
