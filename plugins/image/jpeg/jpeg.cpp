// JPEG, with libjpeg-turbo.
#include <turbojpeg.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "candela/image_plugin.h"

using namespace candela::sdk;

namespace {

using Samples = std::vector<unsigned char>;

struct Destroy {
    void operator()(void* handle) const { tjDestroy(handle); }
    void operator()(unsigned char* bytes) const { tjFree(bytes); }
};
using Handle = std::unique_ptr<void, Destroy>;

Handle require(tjhandle handle) {
    if (handle == nullptr) throw std::runtime_error(tjGetErrorStr2(nullptr));
    return Handle(handle);
}

[[noreturn]] void fail(const Handle& handle) { throw std::runtime_error(tjGetErrorStr2(handle.get())); }

std::string content_of(const char* path) {
    std::ifstream in(path, std::ios::binary);
    std::string content(std::istreambuf_iterator<char>(in), {});
    if (!in.is_open() || in.bad()) throw std::runtime_error("it cannot be read");
    return content;
}

/// Whether the end-of-image marker follows the last scan; neither marker occurs within a scan. If it is
/// missing, the library fills the picture with grey, and its warning is like those about harmless flaws.
bool is_whole(std::string_view file) {
    const std::size_t scan = file.rfind("\xff\xda"), end = file.rfind("\xff\xd9");
    return scan != std::string_view::npos && end != std::string_view::npos && end > scan;
}

// In each of a progressive file's scans, of which there is at least one, a bit may stand for a block of 16 x
// 16 pixels.
constexpr std::uintmax_t k_most_pixels_per_byte = std::uintmax_t{8} * 16 * 16;

struct JpegOptions {
    std::int32_t quality;
};

class Jpeg final : public candela::ImageFormat {
  public:
    explicit Jpeg(const JpegOptions& options) : options_(options) {}

    void write(const candela::ImageView& picture, const char*, candela::ByteSink& sink) const override {
        const Handle handle = require(tjInitCompress());
        unsigned char* bytes = nullptr;
        unsigned long size = 0;
        const int result =
            tjCompress2(handle.get(), picture.bytes.data(), picture.width, 0, picture.height, TJPF_RGB,
                        &bytes, &size, TJSAMP_420, options_.quality, TJFLAG_ACCURATEDCT);
        const std::unique_ptr<unsigned char, Destroy> owner(bytes);
        if (result != 0) fail(handle);
        sink.write(std::as_bytes(std::span(bytes, size)));
    }

    void read(const char* path, candela::ImageSink& sink) const override {
        const std::string file = content_of(path);
        if (!file.starts_with("\xff\xd8\xff")) {
            throw std::runtime_error(file.starts_with("\x89PNG")
                                         ? "it is not a JPEG file but a PNG file; its name must end in .png"
                                         : "it is not a JPEG file");
        }
        if (!is_whole(file)) throw std::runtime_error("it is cut off");
        const auto* const bytes = reinterpret_cast<const unsigned char*>(file.data());
        const Handle handle = require(tjInitDecompress());
        int width = 0, height = 0, subsampling = 0, space = 0;
        if (tjDecompressHeader3(handle.get(), bytes, file.size(), &width, &height, &subsampling, &space) != 0)
            fail(handle);
        require_plausible(static_cast<std::uintmax_t>(width) * static_cast<std::uintmax_t>(height),
                          file.size(), k_most_pixels_per_byte);
        const std::span<float> pixels = sink.allocate(width, height, true);
        // Inks stay separate, and are multiplied below.
        const bool is_cmyk = space == TJCS_CMYK || space == TJCS_YCCK;
        const std::size_t channels = is_cmyk ? 4 : 3;
        Samples samples(pixels.size() / 3 * channels);
        // Warnings are about files that other programs show nevertheless, such as bytes between markers.
        if (tjDecompress2(handle.get(), bytes, file.size(), samples.data(), width, 0, height,
                          is_cmyk ? TJPF_CMYK : TJPF_RGB, TJFLAG_ACCURATEDCT) != 0 &&
            tjGetErrorCode(handle.get()) != TJERR_WARNING)
            fail(handle);
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const unsigned char* const pixel = &samples[i / 3 * channels];
            const auto value = static_cast<float>(pixel[i % 3]) / 255;
            // Inverted, as Adobe's programs write it: 255 means no ink.
            pixels[i] = is_cmyk ? value * static_cast<float>(pixel[3]) / 255 : value;
        }
    }

  private:
    JpegOptions options_;
};

constexpr auto k_fields = fields(
    integer(&JpegOptions::quality, "quality", 95, "from 1 (smallest file) to 100 (closest to the picture)")
        .range(1, 100));

constexpr candela::FileFormat k_formats[] = {
    {.extension = "jpg", .title = "JPEG, 8 bits per channel", .reads = true},
    {.extension = "jpeg", .title = "JPEG, 8 bits per channel", .reads = true}};

}  // namespace

CANDELA_PLUGIN(
    image, Jpeg, k_fields,
    {.title = "JPEG",
     .summary = "Lossy and small: photographs, textures, pictures for the web.",
     .reference =
         "ITU-T T.81 (1992), ISO/IEC 10918-1, Digital compression and coding of continuous-tone still images",
     .formats = k_formats})
