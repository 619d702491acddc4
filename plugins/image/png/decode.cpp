// On errors, libpng calls longjmp(). Its functions are called only by calls(), so that no destructor is
// jumped over.
#include "decode.h"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "candela/image_plugin.h"
#include "libpng.h"

namespace {

/// The file being read, and the error that libpng found in it.
class Decoder {
  public:
    explicit Decoder(std::FILE* file) : file_(file) {
        png_ = libpng.create_read_struct(PNG_LIBPNG_VER_STRING, this, report_error, ignore_warning);
        if (png_ != nullptr) info_ = libpng.create_info_struct(png_);
        if (info_ == nullptr) {
            libpng.destroy_read_struct(&png_, nullptr, nullptr);
            throw std::bad_alloc();
        }
        libpng.set_read_fn(png_, this, read_bytes);
    }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;
    ~Decoder() { libpng.destroy_read_struct(&png_, &info_, nullptr); }

    /// Calls `function(png, info)`, which any libpng call may leave early.
    template <class Function>
    void calls(const Function& function) {
        // NOLINTNEXTLINE(modernize-avoid-setjmp-longjmp)
        if (setjmp(error_) != 0) throw std::runtime_error(message_.data());
        function(png_, info_);
    }

    const LibPng& libpng = LibPng::instance();

  private:
    [[noreturn]] void fail(const char* message) {
        std::snprintf(message_.data(), message_.size(), "%s", message);
        std::longjmp(error_, 1);  // NOLINT(modernize-avoid-setjmp-longjmp)
    }
    [[noreturn]] static void report_error(png_structp png, png_const_charp message) {
        static_cast<Decoder*>(LibPng::instance().get_error_ptr(png))->fail(message);
    }
    static void ignore_warning(png_structp, png_const_charp) {}
    static void read_bytes(png_structp png, png_bytep to, std::size_t count) {
        auto* const decoder = static_cast<Decoder*>(LibPng::instance().get_io_ptr(png));
        if (std::fread(to, 1, count, decoder->file_) != count) decoder->fail("it is cut off");
    }

    std::FILE* file_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
    std::array<char, 128> message_{};
    std::jmp_buf error_{};
};

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

void require_signature(std::FILE* file) {
    constexpr std::string_view k_png = "\x89PNG\r\n\x1a\n", k_jpeg = "\xff\xd8\xff";
    std::array<char, k_png.size()> bytes{};
    const std::string_view begin(bytes.data(), std::fread(bytes.data(), 1, bytes.size(), file));
    if (begin == k_png) return;
    throw std::runtime_error(begin.starts_with(k_jpeg)
                                 ? "it is not a PNG file but a JPEG file; its name must end in .jpg"
                                 : "it is not a PNG file");
}

// Deflate expands one byte to at most 1032, each holding up to eight one-bit pixels.
constexpr std::uintmax_t k_most_pixels_per_byte = std::uintmax_t{1032} * 8;

/// Converts a row's samples of 8 or 16 bits to numbers from 0 to 1. The opacity channel, if any, goes to
/// `opacity`, unless that is null.
void convert(std::span<const png_byte> row, int depth, std::size_t channels, float* to, float* opacity) {
    const std::size_t sample = depth == 16 ? 2 : 1;
    const auto value = [&](const png_byte* at) {
        return depth == 16 ? static_cast<float>(at[0] << 8 | at[1]) / 65535 : static_cast<float>(at[0]) / 255;
    };
    for (std::size_t x = 0; x < row.size(); x += channels * sample) {
        for (std::size_t c = 0; c < 3; ++c) *to++ = value(&row[x + (channels < 3 ? 0 : c * sample)]);
        if (opacity != nullptr) *opacity++ = value(&row[x + (channels - 1) * sample]);
    }
}

}  // namespace

void read_png(const char* path, candela::ImageSink& sink) {
    const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path, "rb"));
    if (file == nullptr) throw std::runtime_error("it cannot be opened");
    require_signature(file.get());
    Decoder decoder(file.get());
    const LibPng& libpng = decoder.libpng;
    png_uint_32 width = 0, height = 0;
    decoder.calls([&](png_structp png, png_infop info) {
        libpng.set_sig_bytes(png, 8);
        libpng.read_info(png, info);
        width = libpng.get_image_width(png, info);
        height = libpng.get_image_height(png, info);
    });
    candela::sdk::require_plausible(std::uintmax_t{width} * height, std::filesystem::file_size(path),
                                    k_most_pixels_per_byte);
    int passes = 1, depth = 0;
    std::size_t channels = 0, row_size = 0;
    decoder.calls([&](png_structp png, png_infop info) {
        libpng.set_expand(png);  // palettes, and samples of fewer than 8 bits
        passes = libpng.set_interlace_handling(png);
        libpng.read_update_info(png, info);
        depth = libpng.get_bit_depth(png, info);
        channels = libpng.get_channels(png, info);
        row_size = libpng.get_rowbytes(png, info);
    });
    const std::span<float> pixels = sink.allocate(static_cast<int>(width), static_cast<int>(height), true);
    const std::span<float> opacity = channels % 2 == 0 ? sink.allocate_opacity() : std::span<float>();

    // Interlaced rows are complete after the last pass.
    const bool is_interlaced = passes > 1;
    std::vector<png_byte> rows(is_interlaced ? row_size * height : row_size);
    for (int pass = 1; pass <= passes; ++pass) {
        for (std::size_t y = 0; y < height; ++y) {
            png_byte* const row = &rows[is_interlaced ? y * row_size : 0];
            decoder.calls([&](png_structp png, png_infop) { libpng.read_row(png, row, nullptr); });
            if (pass == passes)
                convert({row, row_size}, depth, channels, &pixels[3 * y * width],
                        opacity.empty() ? nullptr : &opacity[y * width]);
        }
    }
    decoder.calls([&](png_structp png, png_infop) { libpng.read_end(png, nullptr); });
}
