#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "candela/image_plugin.h"

using namespace candela::sdk;

namespace {

/// A file name that nobody else has, removed again.
class TemporaryFile {
  public:
    explicit TemporaryFile(const std::string& extension) {
        std::string pattern =
            (std::filesystem::temp_directory_path() / "candela-XXXXXX").string() + '.' + extension;
        const int descriptor = ::mkstemps(pattern.data(), static_cast<int>(extension.size() + 1));
        if (descriptor < 0) throw std::runtime_error("no temporary file can be made: " + pattern);
        ::close(descriptor);
        path_ = pattern;
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() { std::remove(path_.c_str()); }

    const std::string& path() const { return path_; }

  private:
    std::string path_;
};

void send_file(const std::string& path, candela::ByteSink& sink) {
    std::ifstream in(path, std::ios::binary);
    std::vector<char> buffer(1 << 16);
    while (in.read(buffer.data(), static_cast<std::streamsize>(buffer.size())), in.gcount() > 0) {
        sink.write(std::as_bytes(std::span(buffer.data(), static_cast<std::size_t>(in.gcount()))));
    }
    if (!in.eof()) throw std::runtime_error("the temporary file cannot be read back: " + path);
}

/// All the formats that OpenImageIO writes. Some of its writers insist on a file of their own, so the bytes
/// take a detour.
class OpenImageIo final : public candela::ImageFormat {
  public:
    explicit OpenImageIo(const NoParams&) {}

    void write(const candela::PictureView& picture, const char* extension,
               candela::ByteSink& sink) const override {
        const bool is_float = picture.pixels == candela::PixelType::real;
        const TemporaryFile file(extension);
        const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(file.path());
        if (output == nullptr) throw std::runtime_error(OIIO::geterror());
        OIIO::ImageSpec spec(picture.width, picture.height, 3, is_float ? OIIO::TypeFloat : OIIO::TypeUInt8);
        if (picture.encoding == candela::ColorEncoding::srgb) {
            spec.attribute("oiio:ColorSpace", is_float ? "Linear" : "sRGB");
        }
        spec.attribute("Software", "Candela");
        // Left out, some writers put the time of writing there, and no two files of one picture are the same.
        spec.attribute("DateTime", "");
        spec.attribute("CompressionQuality", 95);
        const void* const pixels = is_float ? static_cast<const void*>(picture.reals.data())
                                            : static_cast<const void*>(picture.bytes.data());
        if (!output->open(file.path(), spec) ||
            !output->write_image(is_float ? OIIO::TypeFloat : OIIO::TypeUInt8, pixels) || !output->close()) {
            throw std::runtime_error(output->geterror());
        }
        send_file(file.path(), sink);
    }
};

using candela::PixelType;

constexpr candela::FileFormat k_formats[] = {
    {"exr", "OpenEXR, float", PixelType::real},
    {"hdr", "Radiance RGBE, float", PixelType::real},
    {"pfm", "Portable float map", PixelType::real},
    {"tif", "TIFF"},
    {"tiff", "TIFF"},
    {"jpg", "JPEG"},
    {"jpeg", "JPEG"},
    {"bmp", "Windows bitmap"},
    {"tga", "Targa"},
    {"webp", "WebP"},
    {"ppm", "Portable pixmap"},
    {"pnm", "Portable anymap"},
    {"png", "Portable Network Graphics"},
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
