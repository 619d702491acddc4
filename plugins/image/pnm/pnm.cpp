#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "candela/image_plugin.h"

using namespace candela::sdk;

namespace {

/// The two formats that take a dozen lines to write and a few more to read.
class Pnm final : public candela::ImageFormat {
  public:
    explicit Pnm(const NoParams&) {}

    void write(const candela::PictureView& picture, const char* extension,
               candela::ByteSink& sink) const override {
        const std::string size = std::to_string(picture.width) + ' ' + std::to_string(picture.height) + '\n';
        if (std::string_view(extension) == "ppm") {
            put(sink, "P6\n" + size + "255\n");
            sink.write(std::as_bytes(picture.bytes));
            return;
        }
        // The sign of the scale gives the byte order; rows run from the bottom.
        put(sink, "PF\n" + size + (std::endian::native == std::endian::little ? "-1.0\n" : "1.0\n"));
        const std::size_t row = 3 * static_cast<std::size_t>(picture.width);
        for (int y = picture.height - 1; y >= 0; --y) {
            sink.write(std::as_bytes(picture.reals.subspan(static_cast<std::size_t>(y) * row, row)));
        }
    }

    void read(const char* path, candela::PictureSink& sink) const override {
        std::ifstream file(path, std::ios::binary);
        const std::string kind = word(file);
        if (kind != "P6" && kind != "PF")
            throw std::runtime_error("it is neither a binary PPM (P6) nor a PFM (PF)");
        const int width = whole_number(file), height = whole_number(file);
        if (kind == "P6") {
            read_pixmap(file, whole_number(file), sink.allocate(width, height, true));
        } else {
            const bool is_little = word(file).starts_with('-');
            read_floats(file, is_little, width, height, sink.allocate(width, height, false));
        }
    }

  private:
    /// The next word between white space; # begins a comment that ends with the line.
    static std::string word(std::istream& file) {
        std::string text;
        while (file >> text && text.starts_with('#')) std::getline(file, text);
        file.get();  // the single white space after it, which pixels may follow
        if (!file) throw std::runtime_error("its header ends too early");
        return text;
    }

    static int whole_number(std::istream& file) {
        const std::string text = word(file);
        int number = 0;
        const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (problem != std::errc() || end != text.data() + text.size() || number < 1 || number > 65536)
            throw std::runtime_error("'" + text + "' in its header is no number from 1 to 65536");
        return number;
    }

    static void fill(std::istream& file, std::span<char> bytes) {
        file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        if (file.gcount() != static_cast<std::streamsize>(bytes.size()))
            throw std::runtime_error("it ends before its last pixel");
    }

    /// One byte per channel up to 255, otherwise two, most significant first.
    static void read_pixmap(std::istream& file, int largest, std::span<float> pixels) {
        const std::size_t size = largest > 255 ? 2 : 1;
        std::vector<char> bytes(size * pixels.size());
        fill(file, bytes);
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            int value = 0;
            for (std::size_t k = 0; k < size; ++k)
                value = 256 * value + static_cast<unsigned char>(bytes[size * i + k]);
            pixels[i] = std::min(static_cast<float>(value) / static_cast<float>(largest), 1.0f);
        }
    }

    static void read_floats(std::istream& file, bool is_little, int width, int height,
                            std::span<float> pixels) {
        const std::size_t row = 3 * static_cast<std::size_t>(width);
        std::vector<char> bytes(4 * row);
        for (int y = height - 1; y >= 0; --y) {
            fill(file, bytes);
            for (std::size_t i = 0; i < row; ++i) {
                std::uint32_t bits = 0;
                for (std::size_t k = 0; k < 4; ++k)
                    bits = bits << 8 | static_cast<unsigned char>(bytes[4 * i + (is_little ? 3 - k : k)]);
                pixels[static_cast<std::size_t>(y) * row + i] = std::bit_cast<float>(bits);
            }
        }
    }

    static void put(candela::ByteSink& sink, const std::string& text) {
        sink.write(std::as_bytes(std::span(text)));
    }
};

constexpr candela::FileFormat k_formats[] = {
    {"ppm", "Portable pixmap, 8 bits per channel, not compressed", candela::PixelType::byte, true},
    {"pfm", "Portable float map", candela::PixelType::real, true}};

}  // namespace

CANDELA_PLUGIN(
    image, Pnm, k_no_fields,
    {.title = "PPM and PFM",
     .summary = "Uncompressed pictures, 8-bit and float, that every tool reads and a dozen lines write.",
     .reference = "Poskanzer (1988), PPM; Debevec (2001), PFM",
     .formats = k_formats})
