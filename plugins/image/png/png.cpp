// Bands of rows are filtered and compressed by different threads. Where they begin depends only on the
// picture's size, so that the file is the same for any number of threads.
#include <isa-l/crc.h>
#include <isa-l/igzip_lib.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <memory>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "candela/image_plugin.h"
#include "candela/parallel.h"
#include "candela/pool.h"
#include "decode.h"
#include "deflate.h"
#include "filter.h"
#include "scratch.h"

using namespace candela::sdk;

namespace {

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

constexpr std::size_t k_band = std::size_t{1} << 18;         // of pixels, approximately; at least one row
constexpr std::size_t k_at_once = std::size_t{1} << 26;      // of pixels that are compressed together
constexpr std::size_t k_longest_row = std::size_t{1} << 30;  // a band of one row must fit into a chunk
constexpr std::uint32_t k_adler_of_nothing = 1;

Bytes big_endian(std::uint32_t value) {
    return {static_cast<std::uint8_t>(value >> 24), static_cast<std::uint8_t>(value >> 16),
            static_cast<std::uint8_t>(value >> 8), static_cast<std::uint8_t>(value)};
}

void append(Bytes& bytes, ByteView more) { bytes.insert(bytes.end(), more.begin(), more.end()); }

/// Length, type, contents, checksum.
void append_chunk(Bytes& bytes, std::string_view type, std::initializer_list<ByteView> contents) {
    std::size_t size = 0;
    for (const ByteView part : contents) size += part.size();
    bytes.reserve(bytes.size() + size + 12);
    append(bytes, big_endian(static_cast<std::uint32_t>(size)));
    const std::size_t checked = bytes.size();
    bytes.insert(bytes.end(), type.begin(), type.end());
    for (const ByteView part : contents) append(bytes, part);
    append(
        bytes,
        big_endian(static_cast<std::uint32_t>(crc32_gzip_refl(0, &bytes[checked], bytes.size() - checked))));
}

struct Tools {
    explicit Tools(int compression) : deflater(Deflater::create(compression)) {}
    std::unique_ptr<Deflater> deflater;
    Scratch filtered;
};

/// The compressed rows from `begin` to `end`, and their contribution to the checksum of the whole.
struct Band {
    std::size_t begin = 0, end = 0;
    Bytes chunk{};
    std::uint32_t adler = 0;
};

/// Some rows of the picture, from `first` on.
struct Rows {
    const std::uint8_t* pixels;
    std::size_t size;  // of a row, in bytes
    std::size_t first;
    std::size_t of_image;
    ByteView before;  // the row before the first; empty at the top

    const std::uint8_t* at(std::size_t y) const { return pixels + (y - first) * size; }
    const std::uint8_t* above(std::size_t y) const {
        if (y > first) return at(y - 1);
        return before.empty() ? nullptr : before.data();
    }
};

[[noreturn]] void refuse() { throw std::runtime_error("a PNG file cannot hold this picture"); }

struct PngOptions {
    std::int32_t compression;
};

class Png final : public candela::ImageFormat, public candela::ScanlineImageFormat {
  public:
    explicit Png(const PngOptions& options) : options_(options) {}

    void write(const candela::ImageView& picture, const char* extension,
               candela::ByteSink& sink) const override {
        if (picture.bytes.size() != k_pixel * static_cast<std::size_t>(std::max(picture.width, 0)) *
                                        static_cast<std::size_t>(std::max(picture.height, 0)))
            refuse();
        candela::ViewedRows rows(picture);
        write_rows(picture, rows, extension, sink);
    }

    bool writes_rows(const char*) const override { return true; }

    void write_rows(const candela::ImageView& picture, candela::ImageRows& rows, const char*,
                    candela::ByteSink& sink) const override {
        const auto width = static_cast<std::size_t>(std::max(picture.width, 0));
        const auto height = static_cast<std::size_t>(std::max(picture.height, 0));
        if (width == 0 || height == 0 || width > k_longest_row / k_pixel) refuse();
        const std::size_t row = k_pixel * width;

        Bytes head = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
        const std::array<std::uint8_t, 5> kind = {8, 2, 0, 0, 0};  // bits; red, green, blue; no options
        append_chunk(head, "IHDR",
                     {big_endian(static_cast<std::uint32_t>(width)),
                      big_endian(static_cast<std::uint32_t>(height)), kind});
        if (picture.encoding == candela::ColorEncoding::srgb) {
            const std::array<std::uint8_t, 1> perceptual = {0};
            append_chunk(head, "sRGB", {perceptual});
        }
        sink.write(std::as_bytes(std::span(head)));
        const std::size_t count = std::clamp(row * height / k_band + 1, std::size_t{1}, height);
        const auto begin_of = [&](std::size_t band) { return height * band / count; };
        // Allocating memory for each band takes longer than compressing it.
        candela::Pool<Tools> pool;
        const auto make = [&] { return std::make_unique<Tools>(options_.compression); };
        uLong adler = k_adler_of_nothing;
        Bytes above;  // the row before the current ones
        std::vector<Band> bands;
        for (std::size_t first = 0; first < count; first += bands.size()) {
            std::size_t end = first + 1;
            while (end < count && row * (begin_of(end + 1) - begin_of(first)) <= k_at_once) ++end;
            bands.assign(end - first, {});
            const candela::ImageView some = rows.next(static_cast<int>(begin_of(end) - begin_of(first)));
            const Rows at_hand{some.bytes.data(), row, begin_of(first), height, above};
            candela::parallel_for(bands.size(), 1, [&](std::size_t from, std::size_t to) {
                pool.with(make, [&](Tools& tools) {
                    for (std::size_t i = from; i < to; ++i) {
                        bands[i] = {.begin = begin_of(first + i), .end = begin_of(first + i + 1)};
                        encode(at_hand, bands[i], tools);
                    }
                });
            });
            for (const Band& band : bands) {
                sink.write(std::as_bytes(std::span(band.chunk)));
                adler = adler32_combine(adler, band.adler,
                                        static_cast<z_off_t>((row + 1) * (band.end - band.begin)));
            }
            if (end < count)
                above.assign(some.bytes.end() - static_cast<std::ptrdiff_t>(row), some.bytes.end());
        }
        Bytes tail;
        append_chunk(tail, "IDAT", {big_endian(static_cast<std::uint32_t>(adler))});
        append_chunk(tail, "IEND", {});
        sink.write(std::as_bytes(std::span(tail)));
    }

    void read(const char* path, candela::ImageSink& sink) const override { read_png(path, sink); }

  private:
    void encode(const Rows& rows, Band& band, Tools& tools) const {
        const std::span<std::uint8_t> filtered =
            tools.filtered.of_size((rows.size + 1) * (band.end - band.begin));
        std::uint8_t* out = filtered.data();
        for (std::size_t y = band.begin; y < band.end; ++y, out += rows.size + 1)
            filter_row({rows.at(y), rows.size}, rows.above(y), out);
        band.adler = isal_adler32(k_adler_of_nothing, filtered.data(), filtered.size());
        const bool is_last = band.end == rows.of_image;
        // Deflate, with a window of 32 kB.
        static constexpr std::array<std::uint8_t, 2> k_zlib_header = {0x78, 0x01};
        append_chunk(band.chunk, "IDAT",
                     {band.begin == 0 ? ByteView(k_zlib_header) : ByteView(),
                      tools.deflater->deflate(filtered, is_last)});
    }

    PngOptions options_;
};

constexpr auto k_fields = fields(
    integer(&PngOptions::compression, "compression", 1, "from 0 (none) to 9 (smallest file)").range(0, 9));

constexpr candela::FileFormat k_formats[] = {
    {.extension = "png", .title = "Portable Network Graphics, 8 bits per channel", .reads = true}};

}  // namespace

CANDELA_PLUGIN(image, Png, k_fields,
               {.title = "PNG",
                .summary = "The everyday format: lossless, compact, read by every program.",
                .reference = "W3C (2003), Portable Network Graphics (PNG) Specification, second edition",
                .formats = k_formats})
