#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "candela/image_plugin.h"

using namespace candela::sdk;

namespace {

/// Whether a format's files are written row by row, or tile by tile.
bool has_rows(std::string_view extension) {
    return extension == "tif" || extension == "tiff" || extension == "exr";
}

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

constexpr int k_tile = 256;          // pixels, of files that have tiles
constexpr int k_tiled_from = 16384;  // pixels: wider or higher pictures are looked at in parts
constexpr std::size_t k_at_once = std::size_t{1} << 26;  // bytes of pixels

OIIO::ImageSpec spec_of(const candela::PictureView& picture) {
    const bool is_float = picture.pixels == candela::PixelType::real;
    OIIO::ImageSpec spec(picture.width, picture.height, 3, is_float ? OIIO::TypeFloat : OIIO::TypeUInt8);
    if (picture.encoding == candela::ColorEncoding::srgb)
        spec.attribute("oiio:ColorSpace", is_float ? "Linear" : "sRGB");
    return spec;
}

const void* pixels_of(const candela::PictureView& picture) {
    return picture.pixels == candela::PixelType::real ? static_cast<const void*>(picture.reals.data())
                                                      : static_cast<const void*>(picture.bytes.data());
}

/// Whether the end-of-image marker follows the last scan of a JPEG file: within a scan neither occurs. Where
/// it is missing, libjpeg fills up the picture with grey, and OpenImageIO does not pass its warning on.
bool is_whole_jpeg(const char* path) {
    std::ifstream in(path, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(in), {});
    const std::size_t scan = bytes.rfind("\xff\xda"), end = bytes.rfind("\xff\xd9");
    return scan != std::string::npos && end != std::string::npos && end > scan;
}

/// Whether a file that begins as a PNG ends before its last chunk, IEND. Where libpng asks for bytes beyond
/// the end, OpenImageIO's answer jumps over the destructor of the message that it makes.
bool is_cut_off_png(const char* path) {
    constexpr std::string_view k_signature = "\x89PNG\r\n\x1a\n";
    constexpr std::size_t k_around = 12;  // a chunk's length, type and checksum
    std::ifstream in(path, std::ios::binary);
    std::array<char, 8> bytes{};
    const auto read = [&] { return static_cast<bool>(in.read(bytes.data(), bytes.size())); };
    const auto text = [&] { return std::string_view(bytes.data(), bytes.size()); };
    if (!read() || text() != k_signature) return false;
    std::uintmax_t left = std::filesystem::file_size(path) - k_signature.size();
    while (left >= k_around && read()) {
        std::uint32_t length = 0;
        for (const char byte : text().substr(0, 4)) length = length << 8 | static_cast<unsigned char>(byte);
        if (length > left - k_around) return true;
        if (text().substr(4) == "IEND") return false;
        left -= k_around + length;
        in.seekg(std::streamoff{length} + 4, std::ios::cur);
    }
    return true;
}

/// Only of formats that bound how much they compress: a picture of one colour is a few bytes of WebP at any
/// size.
void require_plausible_size(const OIIO::ImageInput& input, const char* path) {
    constexpr std::array<std::string_view, 5> k_bounded = {"png", "bmp", "targa", "hdr", "jpeg"};
    if (std::ranges::find(k_bounded, input.format_name()) == k_bounded.end()) return;
    // Deflate makes up to 1032 bytes of one, each of which is eight pixels of one bit; the others less.
    constexpr std::uintmax_t k_most_pixels_per_byte = std::uintmax_t{1032} * 8;
    require_plausible(input.spec().image_pixels(), std::filesystem::file_size(path), k_most_pixels_per_byte);
}

/// A file that the host writes, as OpenImageIO writes it.
class SinkProxy final : public OIIO::Filesystem::IOProxy {
  public:
    explicit SinkProxy(candela::RandomAccessSink& sink) : IOProxy("picture", Write), sink_(sink) {}

    const char* proxytype() const override { return "sink"; }
    void close() override {}
    std::int64_t tell() override { return position_; }
    bool seek(std::int64_t offset) override {
        position_ = offset;
        return true;
    }
    std::size_t write(const void* bytes, std::size_t size) override {
        const std::size_t written = pwrite(bytes, size, position_);
        position_ += static_cast<std::int64_t>(written);
        return written;
    }
    std::size_t pwrite(const void* bytes, std::size_t size, std::int64_t offset) override {
        // Libraries in C call this; what went wrong is thrown when they have returned.
        try {
            sink_.write_at(static_cast<std::uint64_t>(offset), {static_cast<const std::byte*>(bytes), size});
        } catch (...) {
            if (!problem_) problem_ = std::current_exception();
            return 0;
        }
        size_ = std::max(size_, static_cast<std::size_t>(offset) + size);
        return size;
    }
    std::size_t size() const override { return size_; }

    void throw_problem() const {
        if (problem_) std::rethrow_exception(problem_);
    }

  private:
    candela::RandomAccessSink& sink_;
    std::int64_t position_ = 0;
    std::size_t size_ = 0;
    std::exception_ptr problem_;
};

/// Where the bytes go that a writer makes.
enum class Way {
    memory,  // all at once: some of OpenImageIO's writers insist on a file of their own
    direct   // as they are made, if the sink allows that; a writer must never read them back
};

/// Sends a file of the extension's format, with the pixels that `write_pixels` writes.
template <class WritePixels>
void write_file(OIIO::ImageSpec& spec, const char* extension, candela::ByteSink& sink, Way way,
                const WritePixels& write_pixels) {
    std::optional<SinkProxy> proxy;  // outlives the writer
    const std::unique_ptr<OIIO::ImageOutput> output =
        OIIO::ImageOutput::create(std::string("picture.") + extension);
    if (output == nullptr) throw std::runtime_error(OIIO::geterror());
    spec.attribute("Software", "Candela");
    // If it is missing, some writers insert the current time, and no two files of one picture are the same.
    spec.attribute("DateTime", "");
    spec.attribute("CompressionQuality", 95);
    auto* const random_access = dynamic_cast<candela::RandomAccessSink*>(&sink);
    if (random_access != nullptr && way == Way::direct) {
        proxy.emplace(*random_access);
        const bool is_written = output->set_ioproxy(&*proxy) && output->open("picture", spec) &&
                                write_pixels(*output) && output->close();
        proxy->throw_problem();
        if (!is_written) throw std::runtime_error(output->geterror());
        return;
    }
    const MemoryFile file;
    if (!output->open(file.path(), spec) || !write_pixels(*output) || !output->close())
        throw std::runtime_error(output->geterror());
    file.send(sink);
}

/// All formats that OpenImageIO writes.
class OpenImageIo final : public candela::ImageFormat, public candela::RowFormat {
  public:
    explicit OpenImageIo(const NoParams&) {}

    void write(const candela::PictureView& picture, const char* extension,
               candela::ByteSink& sink) const override {
        if (has_rows(extension)) {
            candela::ViewedRows rows(picture);
            return write_rows(picture, rows, extension, sink);
        }
        OIIO::ImageSpec spec = spec_of(picture);
        write_file(spec, extension, sink, Way::memory, [&](OIIO::ImageOutput& output) {
            return output.write_image(spec.format, pixels_of(picture));
        });
    }

    bool writes_rows(const char* extension) const override { return has_rows(extension); }

    void write_rows(const candela::PictureView& whole, candela::PictureRows& rows, const char* extension,
                    candela::ByteSink& sink) const override {
        OIIO::ImageSpec spec = spec_of(whole);
        const bool has_tiles = std::max(whole.width, whole.height) >= k_tiled_from;
        if (has_tiles) spec.tile_width = spec.tile_height = k_tile;
        const bool is_exr = std::string_view(extension) == "exr";
        // It is in the Exif data of a TIFF, for which libtiff reads back what it has written.
        if (has_tiles && !is_exr) spec.erase_attribute("oiio:ColorSpace");
        const Way way = has_tiles || is_exr ? Way::direct : Way::memory;
        // So many rows at once that all cores have something to compress.
        const auto tile_rows = std::max<std::size_t>(k_at_once / (spec.scanline_bytes(true) * k_tile), 1);
        const int at_once = k_tile * static_cast<int>(std::min<std::size_t>(tile_rows, 1024));
        write_file(spec, extension, sink, way, [&](OIIO::ImageOutput& output) {
            for (int y = 0; y < whole.height;) {
                const candela::PictureView some = rows.next(at_once);
                const int end = y + some.height;
                const bool is_written =
                    has_tiles ? output.write_tiles(0, whole.width, y, end, 0, 1, spec.format, pixels_of(some))
                              : output.write_scanlines(y, end, 0, spec.format, pixels_of(some));
                if (!is_written) return false;
                y = end;
            }
            return true;
        });
    }

    void write_layers(int width, int height, std::span<const candela::PictureChannel> channels,
                      const char* extension, candela::ByteSink& sink) const override {
        OIIO::ImageSpec spec(width, height, static_cast<int>(channels.size()), OIIO::TypeFloat);
        spec.channelnames.clear();
        for (const candela::PictureChannel& channel : channels) spec.channelnames.emplace_back(channel.name);
        spec.attribute("oiio:ColorSpace", "Linear");
        const auto columns = static_cast<std::size_t>(width);
        std::vector<float> row(columns * channels.size());
        write_file(spec, extension, sink, Way::memory, [&](OIIO::ImageOutput& output) {
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
        if (is_cut_off_png(path)) throw std::runtime_error("it is cut off");
        // The colours are as they are in the file, however transparent the pixels.
        OIIO::ImageSpec wanted;
        wanted.attribute("oiio:UnassociatedAlpha", 1);
        const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path, &wanted);
        if (input == nullptr) throw std::runtime_error(OIIO::geterror());
        if (std::string_view(input->format_name()) == "jpeg" && !is_whole_jpeg(path))
            throw std::runtime_error("it is cut off");
        const OIIO::ImageSpec& spec = input->spec();
        if (spec.nchannels < 1) throw std::runtime_error("it has no channels");
        require_plausible_size(*input, path);
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
         "Every other format: OpenEXR, TIFF, Radiance and more. Yields to plugins made for one format.",
     .reference = "Gritz and contributors (2008-), OpenImageIO",
     .properties = k_properties,
     .formats = k_formats})
