#include <algorithm>
#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
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

/// Two formats that take a dozen lines to write and a few more to read.
class Pnm final : public candela::ImageFormat, public candela::ScanlineImageFormat {
  public:
    explicit Pnm(const NoParams&) {}

    void write(const candela::ImageView& picture, const char* extension,
               candela::ByteSink& sink) const override {
        if (writes_rows(extension)) {
            candela::ViewedRows rows(picture);
            return write_rows(picture, rows, extension, sink);
        }
        const std::string size = size_of(picture);
        // The sign of the scale gives the byte order; rows run from the bottom.
        put(sink, "PF\n" + size + (std::endian::native == std::endian::little ? "-1.0\n" : "1.0\n"));
        const std::size_t row = 3 * static_cast<std::size_t>(picture.width);
        for (int y = picture.height - 1; y >= 0; --y) {
            sink.write(std::as_bytes(picture.reals.subspan(static_cast<std::size_t>(y) * row, row)));
        }
    }

    /// A PFM's rows run from the bottom.
    bool writes_rows(const char* extension) const override { return std::string_view(extension) == "ppm"; }

    void write_rows(const candela::ImageView& whole, candela::ImageRows& rows, const char*,
                    candela::ByteSink& sink) const override {
        put(sink, "P6\n" + size_of(whole) + "255\n");
        constexpr int k_at_once = 64;
        for (int y = 0; y < whole.height; y += k_at_once)
            sink.write(std::as_bytes(rows.next(k_at_once).bytes));
    }

    void read(const char* path, candela::ImageSink& sink) const override {
        std::ifstream file(path, std::ios::binary);
        const std::string kind = word(file);
        if (kind != "P6" && kind != "PF")
            throw std::runtime_error("it is neither a binary PPM (P6) nor a PFM (PF)");
        const int width = whole_number(file), height = whole_number(file);
        const std::size_t row = 3 * static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
        if (kind == "P6") {
            const int largest = whole_number(file);
            require_bytes(file, path, rows * row * (largest > 255 ? 2 : 1));
            read_pixmap(file, largest, row, sink.allocate(width, height, true));
        } else {
            const bool is_little = word(file).starts_with('-');
            require_bytes(file, path, rows * row * sizeof(float));
            read_floats(file, is_little, row, sink.allocate(width, height, false));
        }
    }

  private:
    static std::string size_of(const candela::ImageView& picture) {
        return std::to_string(picture.width) + ' ' + std::to_string(picture.height) + '\n';
    }

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
            throw std::runtime_error("'" + text + "' in its header is not a number from 1 to 65536");
        return number;
    }

    /// Checked before memory is allocated on the header's word alone.
    static void require_bytes(std::istream& file, const char* path, std::uintmax_t count) {
        const std::uintmax_t size = std::filesystem::file_size(path);
        const auto begin = static_cast<std::uintmax_t>(file.tellg());
        if (size < begin || size - begin < count) throw std::runtime_error("it ends before its last pixel");
    }

    static void fill(std::istream& file, std::span<char> bytes) {
        file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        if (file.gcount() != static_cast<std::streamsize>(bytes.size()))
            throw std::runtime_error("it ends before its last pixel");
    }

    /// One byte per channel up to 255, otherwise two, most significant first.
    static void read_pixmap(std::istream& file, int largest, std::size_t row, std::span<float> pixels) {
        const std::size_t size = largest > 255 ? 2 : 1;
        std::vector<char> bytes(size * row);
        for (; !pixels.empty(); pixels = pixels.subspan(row)) {
            fill(file, bytes);
            for (std::size_t i = 0; i < row; ++i) {
                int value = 0;
                for (std::size_t k = 0; k < size; ++k)
                    value = 256 * value + static_cast<unsigned char>(bytes[size * i + k]);
                pixels[i] = std::min(static_cast<float>(value) / static_cast<float>(largest), 1.0f);
            }
        }
    }

    /// From the lowest row up.
    static void read_floats(std::istream& file, bool is_little, std::size_t row, std::span<float> pixels) {
        std::vector<char> bytes(4 * row);
        for (; !pixels.empty(); pixels = pixels.first(pixels.size() - row)) {
            fill(file, bytes);
            const std::span<float> lowest = pixels.last(row);
            for (std::size_t i = 0; i < row; ++i) {
                std::uint32_t bits = 0;
                for (std::size_t k = 0; k < 4; ++k)
                    bits = bits << 8 | static_cast<unsigned char>(bytes[4 * i + (is_little ? 3 - k : k)]);
                lowest[i] = std::bit_cast<float>(bits);
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
     .summary =
         "Uncompressed 8-bit and float pictures, which every tool reads and a dozen lines of code write.",
     .reference = "Poskanzer (1988), PPM; Debevec (2001), PFM",
     .formats = k_formats})
