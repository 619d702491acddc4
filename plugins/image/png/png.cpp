// Bands of rows are filtered and compressed by different threads. Where they begin depends only on the
// picture's size, so that the file is the same for any number of threads.
#include <isa-l/igzip_lib.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "candela/image_plugin.h"
#include "candela/parallel.h"
#include "candela/pool.h"
#include "deflate.h"
#include "filter.h"

using namespace candela::sdk;

namespace {

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

constexpr std::size_t k_band = std::size_t{1} << 18;         // of pixels, approximately; at least one row
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
    append(bytes, big_endian(static_cast<std::uint32_t>(
                      crc32(0, &bytes[checked], static_cast<uInt>(bytes.size() - checked)))));
}

struct Tools {
    explicit Tools(int compression) : deflater(Deflater::create(compression)) {}
    std::unique_ptr<Deflater> deflater;
    Bytes filtered;
};

/// The rows from `begin` to `end`, compressed, and their contribution to the checksum of the whole.
struct Band {
    std::size_t begin = 0, end = 0;
    Bytes chunk{};
    std::uint32_t adler = 0;
};

struct PngOptions {
    std::int32_t compression;
};

class Png final : public candela::ImageFormat {
  public:
    explicit Png(const PngOptions& options) : options_(options) {}

    void write(const candela::PictureView& picture, const char*, candela::ByteSink& sink) const override {
        const auto width = static_cast<std::size_t>(std::max(picture.width, 0));
        const auto height = static_cast<std::size_t>(std::max(picture.height, 0));
        if (width == 0 || height == 0 || width > k_longest_row / k_pixel ||
            picture.bytes.size() != k_pixel * width * height)
            throw std::runtime_error("this is no picture that a PNG file can hold");
        const std::size_t row = k_pixel * width;

        const std::size_t count = std::clamp(row * height / k_band + 1, std::size_t{1}, height);
        std::vector<Band> bands(count);
        for (std::size_t i = 0; i < count; ++i)
            bands[i] = {.begin = height * i / count, .end = height * (i + 1) / count};
        // Allocating memory for each band takes longer than compressing it.
        candela::Pool<Tools> pool;
        const auto make = [&] { return std::make_unique<Tools>(options_.compression); };
        candela::parallel_for(count, 1, [&](std::size_t begin, std::size_t end) {
            pool.with(make, [&](Tools& tools) {
                for (std::size_t i = begin; i < end; ++i) encode(picture, bands[i], tools);
            });
        });

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
        uLong adler = k_adler_of_nothing;
        for (const Band& band : bands) {
            sink.write(std::as_bytes(std::span(band.chunk)));
            adler =
                adler32_combine(adler, band.adler, static_cast<z_off_t>((row + 1) * (band.end - band.begin)));
        }
        Bytes tail;
        append_chunk(tail, "IDAT", {big_endian(static_cast<std::uint32_t>(adler))});
        append_chunk(tail, "IEND", {});
        sink.write(std::as_bytes(std::span(tail)));
    }

  private:
    void encode(const candela::PictureView& picture, Band& band, Tools& tools) const {
        const std::size_t row = k_pixel * static_cast<std::size_t>(picture.width);
        tools.filtered.resize((row + 1) * (band.end - band.begin));
        std::uint8_t* out = tools.filtered.data();
        for (std::size_t y = band.begin; y < band.end; ++y, out += row + 1) {
            const std::uint8_t* const pixels = &picture.bytes[y * row];
            filter_row({pixels, row}, y > 0 ? pixels - row : nullptr, out);
        }
        band.adler = isal_adler32(k_adler_of_nothing, tools.filtered.data(), tools.filtered.size());
        const bool is_last = band.end == static_cast<std::size_t>(picture.height);
        // Deflate, with a window of 32 kB.
        static constexpr std::array<std::uint8_t, 2> k_zlib_header = {0x78, 0x01};
        append_chunk(band.chunk, "IDAT",
                     {band.begin == 0 ? ByteView(k_zlib_header) : ByteView(),
                      tools.deflater->deflate(tools.filtered, is_last)});
    }

    PngOptions options_;
};

constexpr auto k_fields = fields(
    integer(&PngOptions::compression, "compression", 1, "from 0, none, to 9, smallest file").range(0, 9));

constexpr candela::FileFormat k_formats[] = {{"png", "Portable Network Graphics, 8 bits per channel"}};

}  // namespace

CANDELA_PLUGIN(image, Png, k_fields,
               {.title = "PNG",
                .summary = "The everyday format: lossless, small, read by everything.",
                .reference = "W3C (2003), Portable Network Graphics (PNG) Specification, second edition",
                .formats = k_formats})
