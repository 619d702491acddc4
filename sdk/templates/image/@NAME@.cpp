#include <candela/image_plugin.h>

#include <cstddef>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

using namespace candela::sdk;

namespace {

/// A line "@NAME@ <width> <height>", then red, green and blue, one byte each, in rows from the top. This is a
/// starting point: put your format here, and name its specification.
class @TYPE@Format final : public candela::ImageFormat {
  public:
    explicit @TYPE@Format(const NoParams&) {}

    void write(const candela::ImageView& image, const char*, candela::ByteSink& sink) const override {
        const std::string header = "@NAME@ " + std::to_string(image.width) + ' ' + std::to_string(image.height) + '\n';
        sink.write(std::as_bytes(std::span(header)));
        sink.write(std::as_bytes(image.bytes));
    }

    // A file may come from anybody: do not trust its header, and do not allocate more memory than its length
    // justifies.
    void read(const char* path, candela::ImageSink& sink) const override {
        std::ifstream file(path, std::ios::binary | std::ios::ate);
        const auto length = static_cast<std::size_t>(file.tellg());
        file.seekg(0);
        std::string name;
        int width = 0, height = 0;
        if (!(file >> name >> width >> height) || name != "@NAME@" || file.get() != '\n')
            throw std::runtime_error("it does not begin like a .@NAME@ file");
        if (width < 1 || width > 65536 || height < 1 || height > 65536)
            throw std::runtime_error("its width or height is not from 1 to 65536");
        const std::size_t size = 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
        if (length < size) throw std::runtime_error("it ends before its last pixel");
        std::vector<char> bytes(size);
        if (!file.read(bytes.data(), static_cast<std::streamsize>(size)))
            throw std::runtime_error("it ends before its last pixel");
        const std::span<float> values = sink.allocate(width, height, true);
        for (std::size_t i = 0; i < size; ++i) values[i] = static_cast<float>(static_cast<unsigned char>(bytes[i])) / 255;
    }
};

constexpr candela::FileFormat k_formats[] = {
    {.extension = "@NAME@", .title = "@TITLE@", .pixels = candela::PixelType::byte, .reads = true}};

}  // namespace

CANDELA_PLUGIN(image, @TYPE@Format, k_no_fields,
               {.title = "@TITLE@",
                .summary = "One sentence about it.",
                .reference = "Author (year), Title",
                .formats = k_formats})
