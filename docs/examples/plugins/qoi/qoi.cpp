// Dominic Szablewski (2021), "The Quite OK Image Format", specification 1.0: a pixel is stored as a
// repetition, an index of an earlier pixel, a small difference, or its own value.
#include <candela/image_plugin.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vector>

using namespace candela::sdk;

namespace {

using Byte = std::uint8_t;

struct Pixel {
    Byte r = 0, g = 0, b = 0, a = 255;
    friend bool operator==(const Pixel&, const Pixel&) = default;
    std::size_t place() const { return (r * 3u + g * 5u + b * 7u + a * 11u) % 64; }
};

constexpr Byte k_index = 0x00, k_diff = 0x40, k_luma = 0x80, k_run = 0xc0, k_rgb = 0xfe, k_rgba = 0xff;
constexpr std::size_t k_longest_run = 62;
constexpr std::array<Byte, 8> k_end{0, 0, 0, 0, 0, 0, 0, 1};

class Qoi final : public candela::ImageFormat {
  public:
    explicit Qoi(const NoParams&) {}

    void write(const candela::ImageView& picture, const char*, candela::ByteSink& sink) const override {
        std::vector<Byte> out{'q', 'o', 'i', 'f'};
        for (const int number : {picture.width, picture.height}) {
            for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<Byte>(number >> shift));
        }
        out.insert(out.end(),
                   {Byte{3}, static_cast<Byte>(picture.encoding == candela::ColorEncoding::srgb ? 0 : 1)});
        std::array<Pixel, 64> seen{};
        for (Pixel& pixel : seen) pixel.a = 0;
        Pixel previous;
        std::size_t run = 0;
        const auto end_run = [&] {
            if (run > 0) out.push_back(static_cast<Byte>(k_run | (run - 1)));
            run = 0;
        };
        for (std::size_t i = 0; i + 2 < picture.bytes.size(); i += 3) {
            const Pixel pixel{picture.bytes[i], picture.bytes[i + 1], picture.bytes[i + 2]};
            if (pixel == previous) {
                if (++run == k_longest_run) end_run();
                continue;
            }
            end_run();
            Pixel& same_place = seen[pixel.place()];
            if (same_place == pixel) {
                out.push_back(static_cast<Byte>(k_index | pixel.place()));
            } else {
                same_place = pixel;
                write_difference(pixel, previous, out);
            }
            previous = pixel;
        }
        end_run();
        out.insert(out.end(), k_end.begin(), k_end.end());
        sink.write(std::as_bytes(std::span(out)));
    }

    void read(const char* path, candela::ImageSink& sink) const override {
        std::ifstream file(path, std::ios::binary);
        const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
        std::size_t at = 0;
        const auto next = [&] {
            if (at >= bytes.size()) throw std::runtime_error("it ends before its last pixel");
            return static_cast<Byte>(bytes[at++]);
        };
        const auto size = [&] {
            std::uint32_t number = 0;
            for (int i = 0; i < 4; ++i) number = number << 8 | next();
            if (number < 1 || number > 65536)
                throw std::runtime_error("its width or height is not from 1 to 65536");
            return static_cast<int>(number);
        };
        if (bytes.size() < 14 || std::memcmp(bytes.data(), "qoif", 4) != 0)
            throw std::runtime_error("it is not a QOI picture");
        at = 4;
        const int width = size(), height = size();
        at += 2;  // channels and colour space, which do not affect the pixels that follow
                  // A byte holds at most 62 pixels: a file that claims more is cut off, and gets no memory.
        const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
        if (pixels > k_longest_run * bytes.size()) throw std::runtime_error("it ends before its last pixel");
        const std::span<float> values = sink.allocate(width, height, true);
        std::array<Pixel, 64> seen{};
        for (Pixel& pixel : seen) pixel.a = 0;
        Pixel pixel;
        std::size_t run = 0;
        for (std::size_t i = 0; i < pixels; ++i) {
            if (run > 0) {
                --run;
            } else {
                const Byte tag = next();
                if (tag >= k_run && tag < k_rgb)
                    run = tag - k_run;
                else
                    pixel = read_pixel(tag, pixel, seen, next);
                seen[pixel.place()] = pixel;
            }
            values[3 * i] = static_cast<float>(pixel.r) / 255;
            values[3 * i + 1] = static_cast<float>(pixel.g) / 255;
            values[3 * i + 2] = static_cast<float>(pixel.b) / 255;
        }
        for (const Byte expected : k_end)
            if (next() != expected) throw std::runtime_error("it lacks the end mark of a QOI picture");
    }

  private:
    static void write_difference(Pixel pixel, Pixel before, std::vector<Byte>& out) {
        const int r = static_cast<std::int8_t>(pixel.r - before.r),
                  g = static_cast<std::int8_t>(pixel.g - before.g),
                  b = static_cast<std::int8_t>(pixel.b - before.b);
        const auto within = [](int low, int x, int high) { return low <= x && x <= high; };
        if (within(-2, r, 1) && within(-2, g, 1) && within(-2, b, 1)) {
            out.push_back(static_cast<Byte>(k_diff | (r + 2) << 4 | (g + 2) << 2 | (b + 2)));
        } else if (within(-32, g, 31) && within(-8, r - g, 7) && within(-8, b - g, 7)) {
            out.push_back(static_cast<Byte>(k_luma | (g + 32)));
            out.push_back(static_cast<Byte>((r - g + 8) << 4 | (b - g + 8)));
        } else {
            out.insert(out.end(), {k_rgb, pixel.r, pixel.g, pixel.b});
        }
    }

    template <class Next>
    static Pixel read_pixel(Byte tag, Pixel pixel, const std::array<Pixel, 64>& seen, Next next) {
        if (tag == k_rgb || tag == k_rgba) {
            for (Byte* channel : {&pixel.r, &pixel.g, &pixel.b}) *channel = next();
            if (tag == k_rgba) pixel.a = next();
            return pixel;
        }
        if (tag < k_diff) return seen[tag];
        const bool is_luma = tag >= k_luma;
        const int second = is_luma ? next() : 0, green = is_luma ? (tag & 63) - 32 : (tag >> 2 & 3) - 2;
        const int red = is_luma ? green + (second >> 4) - 8 : (tag >> 4 & 3) - 2;
        const int blue = is_luma ? green + (second & 15) - 8 : (tag & 3) - 2;
        return {static_cast<Byte>(pixel.r + red), static_cast<Byte>(pixel.g + green),
                static_cast<Byte>(pixel.b + blue), pixel.a};
    }
};

constexpr candela::FileFormat k_formats[] = {
    {"qoi", "Quite OK Image, lossless compression", candela::PixelType::byte, true}};

}  // namespace

CANDELA_PLUGIN(image, Qoi, k_no_fields,
               {.title = "QOI",
                .summary = "Lossless pictures, smaller than PPM and written faster than PNG.",
                .reference = "Szablewski (2021), The Quite OK Image Format, specification 1.0",
                .formats = k_formats})
