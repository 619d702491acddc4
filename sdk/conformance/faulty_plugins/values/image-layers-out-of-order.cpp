// Writes floats correctly, but in a picture with layers it puts blue where red belongs.
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "candela/image_plugin.h"

namespace {

using Size = std::array<std::int32_t, 2>;

class LayersOutOfOrder final : public candela::ImageFormat {
  public:
    explicit LayersOutOfOrder(const candela::sdk::NoParams&) {}

    void write(const candela::ImageView& picture, const char*, candela::ByteSink& sink) const override {
        const Size size{picture.width, picture.height};
        sink.write(std::as_bytes(std::span(size)));
        sink.write(std::as_bytes(picture.reals));
    }

    void write_layers(int width, int height, std::span<const candela::ImageChannel> channels, const char*,
                      candela::ByteSink& sink) const override {
        const Size size{width, height};
        sink.write(std::as_bytes(std::span(size)));
        for (std::size_t i = 0; i < channels[0].values.size(); ++i) {
            const std::array<float, 3> pixel{channels[2].values[i], channels[1].values[i],
                                             channels[0].values[i]};
            sink.write(std::as_bytes(std::span(pixel)));
        }
    }

    void read(const char* path, candela::ImageSink& sink) const override {
        std::ifstream in(path, std::ios::binary);
        Size size{};
        if (!in.read(reinterpret_cast<char*>(size.data()), sizeof(size)) || size[0] < 1 || size[1] < 1)
            throw std::runtime_error("no head");
        const auto floats = 3 * static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
        if (std::filesystem::file_size(path) != sizeof(size) + sizeof(float) * floats)
            throw std::runtime_error("it is cut off");
        const std::span<float> values = sink.allocate(size[0], size[1], false);
        in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(values.size_bytes()));
    }
};

constexpr candela::FileFormat k_formats[] = {{.extension = "floats",
                                              .title = "Floats",
                                              .pixels = candela::PixelType::real,
                                              .reads = true,
                                              .layers = true}};

}  // namespace

CANDELA_PLUGIN(
    image, LayersOutOfOrder, candela::sdk::k_no_fields,
    {.title = "LayersOutOfOrder", .summary = "Bad on purpose.", .reference = "none", .formats = k_formats})
