#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
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

/// A file in memory with a path, which cannot be left behind.
class MemoryFile {
  public:
    MemoryFile() : descriptor_(::memfd_create("candela", MFD_CLOEXEC)) {
        if (descriptor_ < 0) throw std::runtime_error("no file can be made in memory");
    }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    ~MemoryFile() { ::close(descriptor_); }

    std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

    void send(candela::ByteSink& sink) const {
        std::vector<std::byte> buffer(1 << 16);
        off_t offset = 0;
        for (;;) {
            const ssize_t count = ::pread(descriptor_, buffer.data(), buffer.size(), offset);
            if (count < 0) throw std::runtime_error("the file in memory cannot be read back");
            if (count == 0) return;
            sink.write(std::span(buffer).first(static_cast<std::size_t>(count)));
            offset += count;
        }
    }

  private:
    int descriptor_;
};

/// Whether the end-of-image marker follows the last scan of a JPEG file: within a scan neither occurs. Where
/// it is missing, libjpeg fills up the picture with grey, and OpenImageIO does not pass its warning on.
bool is_whole_jpeg(const char* path) {
    std::ifstream in(path, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(in), {});
    const std::size_t scan = bytes.rfind("\xff\xda"), end = bytes.rfind("\xff\xd9");
    return scan != std::string::npos && end != std::string::npos && end > scan;
}

/// Sends a file of the extension's format, with the pixels that `write_pixels` writes. Some of OpenImageIO's
/// writers insist on a file of their own, so the bytes take a detour.
template <class WritePixels>
void write_file(OIIO::ImageSpec& spec, const char* extension, candela::ByteSink& sink,
                const WritePixels& write_pixels) {
    const MemoryFile file;
    const std::unique_ptr<OIIO::ImageOutput> output =
        OIIO::ImageOutput::create(std::string("picture.") + extension);
    if (output == nullptr) throw std::runtime_error(OIIO::geterror());
    spec.attribute("Software", "Candela");
    // If it is missing, some writers insert the current time, and no two files of one picture are the same.
    spec.attribute("DateTime", "");
    spec.attribute("CompressionQuality", 95);
    if (!output->open(file.path(), spec) || !write_pixels(*output) || !output->close())
        throw std::runtime_error(output->geterror());
    file.send(sink);
}

/// All formats that OpenImageIO writes.
class OpenImageIo final : public candela::ImageFormat {
  public:
    explicit OpenImageIo(const NoParams&) {}

    void write(const candela::PictureView& picture, const char* extension,
               candela::ByteSink& sink) const override {
        const bool is_float = picture.pixels == candela::PixelType::real;
        const OIIO::TypeDesc type = is_float ? OIIO::TypeFloat : OIIO::TypeUInt8;
        OIIO::ImageSpec spec(picture.width, picture.height, 3, type);
        if (picture.encoding == candela::ColorEncoding::srgb) {
            spec.attribute("oiio:ColorSpace", is_float ? "Linear" : "sRGB");
        }
        const void* const pixels = is_float ? static_cast<const void*>(picture.reals.data())
                                            : static_cast<const void*>(picture.bytes.data());
        write_file(spec, extension, sink,
                   [&](OIIO::ImageOutput& output) { return output.write_image(type, pixels); });
    }

    void write_layers(int width, int height, std::span<const candela::PictureChannel> channels,
                      const char* extension, candela::ByteSink& sink) const override {
        OIIO::ImageSpec spec(width, height, static_cast<int>(channels.size()), OIIO::TypeFloat);
        spec.channelnames.clear();
        for (const candela::PictureChannel& channel : channels) spec.channelnames.emplace_back(channel.name);
        spec.attribute("oiio:ColorSpace", "Linear");
        const auto columns = static_cast<std::size_t>(width);
        std::vector<float> row(columns * channels.size());
        write_file(spec, extension, sink, [&](OIIO::ImageOutput& output) {
            for (int y = 0; y < height; ++y) {
                const std::size_t first = static_cast<std::size_t>(y) * columns;
                for (std::size_t c = 0; c < channels.size(); ++c) {
                    for (std::size_t x = 0; x < columns; ++x)
                        row[x * channels.size() + c] = channels[c].values[first + x];
                }
                if (!output.write_scanline(y, 0, OIIO::TypeFloat, row.data())) return false;
            }
            return true;
        });
    }

    void read(const char* path, candela::PictureSink& sink) const override {
        const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path);
        if (input == nullptr) throw std::runtime_error(OIIO::geterror());
        if (std::string_view(input->format_name()) == "jpeg" && !is_whole_jpeg(path))
            throw std::runtime_error("it is cut off");
        const OIIO::ImageSpec& spec = input->spec();
        if (spec.nchannels < 1) throw std::runtime_error("it has no channels");
        const bool is_float = spec.format.is_floating_point();
        const std::span<float> pixels = sink.allocate(spec.width, spec.height, !is_float);
        // Grey pictures have one channel; channels after the third are alpha and the like.
        const int channels = std::min(spec.nchannels, 3);
        std::vector<float> row(static_cast<std::size_t>(spec.width) *
                               static_cast<std::size_t>(spec.nchannels));
        std::size_t next = 0;
        for (int y = 0; y < spec.height; ++y) {
            if (!input->read_scanline(spec.y + y, 0, OIIO::TypeFloat, row.data()))
                throw std::runtime_error(input->geterror());
            for (std::size_t x = 0; x < row.size(); x += static_cast<std::size_t>(spec.nchannels)) {
                for (int c = 0; c < 3; ++c)
                    pixels[next++] = row[x + static_cast<std::size_t>(channels < 3 ? 0 : c)];
            }
        }
    }
};

using candela::PixelType;

constexpr candela::FileFormat k_formats[] = {
    {.extension = "exr", .title = "OpenEXR, float", .pixels = PixelType::real, .reads = true, .layers = true},
    {"hdr", "Radiance RGBE, float", PixelType::real, true},
    {"tif", "TIFF", PixelType::byte, true},
    {"tiff", "TIFF", PixelType::byte, true},
    {"jpg", "JPEG", PixelType::byte, true},
    {"jpeg", "JPEG", PixelType::byte, true},
    {"bmp", "Windows bitmap", PixelType::byte, true},
    {"tga", "Targa", PixelType::byte, true},
    {"webp", "WebP", PixelType::byte, true},
    {"ppm", "Portable pixmap", PixelType::byte, true},
    {"pnm", "Portable anymap", PixelType::byte, true},
    {"png", "Portable Network Graphics", PixelType::byte, true},
};

constexpr candela::Property k_properties[] = {{"fallback"}};

}  // namespace

CANDELA_PLUGIN(
    image, OpenImageIo, k_no_fields,
    {.title = "OpenImageIO",
     .summary =
         "Every other format: OpenEXR, TIFF, JPEG, Radiance and more. Yields to plugins made for one format.",
     .reference = "Gritz and contributors (2008-), OpenImageIO",
     .properties = k_properties,
     .formats = k_formats})
