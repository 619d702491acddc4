#include <algorithm>
#include <bit>
#include <string>
#include <string_view>
#include <vector>

#include "candela/image_plugin.h"

using namespace candela::sdk;

namespace {

/// The two formats that a dozen lines can write, and everything can read.
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
        // The sign of the scale tells the byte order; rows run from the bottom.
        put(sink, "PF\n" + size + (std::endian::native == std::endian::little ? "-1.0\n" : "1.0\n"));
        const std::size_t row = 3 * static_cast<std::size_t>(picture.width);
        for (int y = picture.height - 1; y >= 0; --y) {
            sink.write(std::as_bytes(picture.reals.subspan(static_cast<std::size_t>(y) * row, row)));
        }
    }

  private:
    static void put(candela::ByteSink& sink, const std::string& text) {
        sink.write(std::as_bytes(std::span(text)));
    }
};

constexpr candela::FileFormat k_formats[] = {{"ppm", "Portable pixmap, 8 bits a channel, not compressed"},
                                             {"pfm", "Portable float map", candela::PixelType::real}};

}  // namespace

CANDELA_PLUGIN(
    image, Pnm, k_no_fields,
    {.title = "PPM and PFM",
     .summary = "Uncompressed pictures, 8-bit and float, that every tool reads and a dozen lines write.",
     .reference = "Poskanzer (1988), PPM; Debevec (2001), PFM",
     .formats = k_formats})
