// Shared by the faulty readers: a run-length format (a count below 256, then red, green and blue) without
// fault, to be spoiled.
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>

#include "candela/image_plugin.h"

namespace faulty {

class Runs : public candela::ImageFormat {
  public:
    explicit Runs(const candela::sdk::NoParams&) {}

    void write(const candela::ImageView& picture, const char*, candela::ByteSink& sink) const override {
        std::string text = std::to_string(picture.width) + ' ' + std::to_string(picture.height) + '\n';
        const std::size_t size = picture.bytes.size();
        const auto pixel = [&](std::size_t at) { return picture.bytes.subspan(at, 3); };
        for (std::size_t at = 0, end = 0; at < size; at = end) {
            for (end = at; end < size && (end - at) / 3 < 255; end += 3) {
                if (pixel(end)[0] != pixel(at)[0] || pixel(end)[1] != pixel(at)[1] ||
                    pixel(end)[2] != pixel(at)[2])
                    break;
            }
            text += static_cast<char>(count_for((end - at) / 3));
            for (const std::uint8_t channel : pixel(at)) text += static_cast<char>(channel);
        }
        sink.write(std::as_bytes(std::span(text)));
    }

    void read(const char* path, candela::ImageSink& sink) const override {
        std::ifstream in(path, std::ios::binary);
        int width = 0, height = 0;
        if (!(in >> width >> height) || in.get() != '\n' || width < 1 || height < 1)
            throw std::runtime_error("no head");
        const std::string runs(std::istreambuf_iterator<char>(in), {});
        const std::span<float> values = sink.allocate(width, height, true);
        std::size_t to = 0;
        for (std::size_t at = 0; at + 4 <= runs.size() && to < values.size(); at += 4) {
            for (int i = static_cast<std::uint8_t>(runs[at]); i > 0 && to < values.size(); --i) {
                for (std::size_t c = 1; c < 4; ++c)
                    values[to++] = static_cast<float>(static_cast<std::uint8_t>(runs[at + c])) / 255;
            }
        }
        if (to < values.size() && minds_the_end()) throw std::runtime_error("it is cut off");
    }

  protected:
    virtual std::size_t count_for(std::size_t pixels) const { return pixels; }
    virtual bool minds_the_end() const { return true; }
};

constexpr candela::FileFormat k_run_formats[] = {{.extension = "runs", .title = "Runs", .reads = true}};

}  // namespace faulty

#define FAULTY_RUNS(Format)                                  \
    CANDELA_PLUGIN(image, Format, candela::sdk::k_no_fields, \
                   {.title = #Format,                        \
                    .summary = "Bad on purpose.",            \
                    .reference = "none",                     \
                    .formats = faulty::k_run_formats})
