#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "candela/file_descriptor.h"
#include "candela/image_plugin.h"
#include "input.h"

using namespace candela::sdk;

namespace {

/// Whether a format's files are written row by row, or tile by tile.
bool has_rows(std::string_view extension) {
    return extension == "tif" || extension == "tiff" || extension == "exr";
}

/// The largest file size allowed here (ulimit -f), which also applies to files in memory.
std::uint64_t file_size_limit() {
    rlimit limit{};
    if (::getrlimit(RLIMIT_FSIZE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return std::numeric_limits<std::uint64_t>::max();
    return limit.rlim_cur;
}

/// A file in memory that has a path and never outlives the process.
class MemoryFile {
  public:
    MemoryFile() : descriptor_(::memfd_create("candela", MFD_CLOEXEC)) {
        if (!descriptor_.is_open()) throw std::runtime_error("cannot create a file in memory");
    }

    std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_.number()); }

    /// Writers ignore some errors, such as those when writing their last bytes.
    void require_whole(const OIIO::ImageSpec& spec) const {
        struct stat status{};
        if (::fstat(descriptor_.number(), &status) != 0)
            throw std::runtime_error("cannot read back the file in memory");
        // The part that did not fit may be a number at an even offset.
        if (static_cast<std::uint64_t>(status.st_size) + 1 >= file_size_limit())
            throw std::runtime_error("the file would exceed the limit on file sizes (ulimit -f)");
        const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path());
        std::vector<std::byte> row(spec.scanline_bytes());
        const bool is_whole =
            input != nullptr && input->spec().width == spec.width && input->spec().height == spec.height &&
            input->spec().nchannels == spec.nchannels && input->spec().format == spec.format &&
            (spec.tile_width > 0 || input->read_scanline(spec.height - 1, 0, spec.format, row.data()));
        if (!is_whole) throw std::runtime_error("the file in memory is incomplete");
    }

    void send(candela::ByteSink& sink) const {
        std::vector<std::byte> buffer(1 << 16);
        off_t offset = 0;
        for (;;) {
            const ssize_t count = ::pread(descriptor_.number(), buffer.data(), buffer.size(), offset);
            if (count < 0) throw std::runtime_error("cannot read back the file in memory");
            if (count == 0) return;
            sink.write(std::span(buffer).first(static_cast<std::size_t>(count)));
            offset += count;
        }
    }

  private:
    candela::FileDescriptor descriptor_;
};

constexpr int k_tile = 256;          // pixels, for files that have tiles
constexpr int k_tiled_from = 16384;  // pixels: wider or higher pictures are handled in parts
constexpr std::size_t k_at_once = std::size_t{1} << 26;  // bytes of pixels

OIIO::ImageSpec spec_of(const candela::ImageView& picture) {
    const bool is_float = picture.pixels == candela::PixelType::real;
    OIIO::ImageSpec spec(picture.width, picture.height, 3, is_float ? OIIO::TypeFloat : OIIO::TypeUInt8);
    if (picture.encoding == candela::ColorEncoding::srgb)
        spec.attribute("oiio:ColorSpace", is_float ? "Linear" : "sRGB");
    return spec;
}

const void* pixels_of(const candela::ImageView& picture) {
    return picture.pixels == candela::PixelType::real ? static_cast<const void*>(picture.reals.data())
                                                      : static_cast<const void*>(picture.bytes.data());
}

/// The file that OpenImageIO writes to. C libraries call it, so errors are thrown after they have returned,
/// whether or not they reported them.
class WriteProxy : public OIIO::Filesystem::IOProxy {
  public:
    WriteProxy() : IOProxy("picture", Write) {}

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
        try {
            put(static_cast<std::uint64_t>(offset), {static_cast<const std::byte*>(bytes), size});
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

  protected:
    virtual void put(std::uint64_t offset, std::span<const std::byte> bytes) = 0;

  private:
    std::int64_t position_ = 0;
    std::size_t size_ = 0;
    std::exception_ptr problem_;
};

/// A file that the host writes.
class SinkProxy final : public WriteProxy {
  public:
    explicit SinkProxy(candela::RandomAccessSink& sink) : sink_(sink) {}
    const char* proxytype() const override { return "sink"; }

  private:
    void put(std::uint64_t offset, std::span<const std::byte> bytes) override {
        sink_.write_at(offset, bytes);
    }

    candela::RandomAccessSink& sink_;
};

/// A file that the host receives when it is complete.
class MemoryProxy final : public WriteProxy {
  public:
    const char* proxytype() const override { return "memory"; }

    void send(candela::ByteSink& sink) const {
        std::size_t left = size();
        for (const Block& block : blocks_) {
            const std::size_t some = std::min(left, k_block);
            sink.write(std::span(*block).first(some));
            left -= some;
        }
    }

  private:
    static constexpr std::size_t k_block = 1 << 20;
    using Block = std::unique_ptr<std::array<std::byte, k_block>>;

    void put(std::uint64_t offset, std::span<const std::byte> bytes) override {
        while (!bytes.empty()) {
            const std::size_t at = offset % k_block, some = std::min(bytes.size(), k_block - at);
            while (blocks_.size() <= offset / k_block)
                blocks_.push_back(std::make_unique<std::array<std::byte, k_block>>());
            std::ranges::copy(bytes.first(some),
                              blocks_[offset / k_block]->begin() + static_cast<std::ptrdiff_t>(at));
            offset += some;
            bytes = bytes.subspan(some);
        }
    }

    std::vector<Block> blocks_;
};

/// The destination of a writer's bytes.
enum class Way {
    memory,  // all at once: many writers seek back in their output
    file,    // all at once, through a file in memory: the writer reads back its output
    direct   // as they are produced, if the sink allows that
};

/// Makes the writer write to the proxy.
template <class WritePixels>
void write_through(WriteProxy& proxy, OIIO::ImageOutput& output, const OIIO::ImageSpec& spec,
                   const WritePixels& write_pixels) {
    const bool is_written =
        output.set_ioproxy(&proxy) && output.open("picture", spec) && write_pixels(output) && output.close();
    proxy.throw_problem();
    if (!is_written) throw std::runtime_error(output.geterror());
}

/// Sends a file in the extension's format, with the pixels that `write_pixels` writes.
template <class WritePixels>
void write_file(OIIO::ImageSpec& spec, const char* extension, candela::ByteSink& sink, Way way,
                const WritePixels& write_pixels) {
    std::optional<SinkProxy> direct;  // proxies outlive the writer
    MemoryProxy memory;
    const std::unique_ptr<OIIO::ImageOutput> output =
        OIIO::ImageOutput::create(std::string("picture.") + extension);
    if (output == nullptr) throw std::runtime_error(OIIO::geterror());
    spec.attribute("Software", "Candela");
    // If it is missing, some writers insert the current time, so that no two files of a picture are the same.
    spec.attribute("DateTime", "");
    spec.attribute("CompressionQuality", 95);
    auto* const random_access = dynamic_cast<candela::RandomAccessSink*>(&sink);
    if (random_access != nullptr && way == Way::direct) {
        direct.emplace(*random_access);
        return write_through(*direct, *output, spec, write_pixels);
    }
    if (way != Way::file && output->supports("ioproxy")) {
        write_through(memory, *output, spec, write_pixels);
        return memory.send(sink);
    }
    const MemoryFile file;
    if (!output->open(file.path(), spec) || !write_pixels(*output) || !output->close())
        throw std::runtime_error(output->geterror());
    file.require_whole(spec);
    file.send(sink);
}

/// All formats that OpenImageIO writes.
class OpenImageIo final : public candela::ImageFormat, public candela::ScanlineImageFormat {
  public:
    explicit OpenImageIo(const NoParams&) {}

    void write(const candela::ImageView& picture, const char* extension,
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

    void write_rows(const candela::ImageView& whole, candela::ImageRows& rows, const char* extension,
                    candela::ByteSink& sink) const override {
        OIIO::ImageSpec spec = spec_of(whole);
        const bool has_tiles = std::max(whole.width, whole.height) >= k_tiled_from;
        if (has_tiles) spec.tile_width = spec.tile_height = k_tile;
        const bool is_exr = std::string_view(extension) == "exr";
        // In a TIFF it goes into the Exif data, for which libtiff reads back its own output.
        if (has_tiles && !is_exr) spec.erase_attribute("oiio:ColorSpace");
        const Way way = has_tiles || is_exr ? Way::direct : Way::file;
        // Enough rows at once to keep all cores busy compressing.
        const auto tile_rows = std::max<std::size_t>(k_at_once / (spec.scanline_bytes(true) * k_tile), 1);
        const int at_once = k_tile * static_cast<int>(std::min<std::size_t>(tile_rows, 1024));
        write_file(spec, extension, sink, way, [&](OIIO::ImageOutput& output) {
            for (int y = 0; y < whole.height;) {
                const candela::ImageView some = rows.next(at_once);
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

    void write_layers(int width, int height, std::span<const candela::ImageChannel> channels,
                      const char* extension, candela::ByteSink& sink) const override {
        OIIO::ImageSpec spec(width, height, static_cast<int>(channels.size()), OIIO::TypeFloat);
        spec.channelnames.clear();
        for (const candela::ImageChannel& channel : channels) spec.channelnames.emplace_back(channel.name);
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

    void read(const char* path, candela::ImageSink& sink) const override {
        const std::unique_ptr<OIIO::ImageInput> input = openimageio::opened(path);
        const OIIO::ImageSpec& spec = input->spec();
        const std::span<float> pixels =
            sink.allocate(spec.width, spec.height, !spec.format.is_floating_point());
        // Grey pictures have one channel; channels after the third are alpha and the like. Read all at once:
        // row by row, a file with tiles or a plane per channel would be decoded once per row.
        const bool is_grey = spec.nchannels < 3;
        constexpr OIIO::stride_t k_pixel = 3 * sizeof(float);
        if (!input->read_image(0, 0, 0, is_grey ? 1 : 3, OIIO::TypeFloat, pixels.data(), k_pixel))
            throw std::runtime_error(input->geterror());
        if (is_grey)
            for (std::size_t i = 0; i < pixels.size(); i += 3) pixels[i + 1] = pixels[i + 2] = pixels[i];
        if (spec.alpha_channel < 0 || spec.alpha_channel >= spec.nchannels) return;
        const std::span<float> opacity = sink.allocate_opacity();
        if (!opacity.empty() && !input->read_image(0, 0, spec.alpha_channel, spec.alpha_channel + 1,
                                                   OIIO::TypeFloat, opacity.data(), sizeof(float)))
            throw std::runtime_error(input->geterror());
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
         "All other formats: OpenEXR, TIFF, Radiance and more. Yields to plugins dedicated to one format.",
     .reference = "Gritz and contributors (2008-), OpenImageIO",
     .properties = k_properties,
     .formats = k_formats})
