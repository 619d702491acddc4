#include <spng.h>

#include <exception>
#include <memory>
#include <stdexcept>
#include <string>

#include "candela/image_plugin.h"

using namespace candela::sdk;

namespace {

struct PngOptions {
    std::int32_t compression;
};

class Png final : public candela::ImageFormat {
  public:
    explicit Png(const PngOptions& options) : options_(options) {}

    void write(const candela::PictureView& picture, const char*, candela::ByteSink& sink) const override {
        const std::unique_ptr<spng_ctx, void (*)(spng_ctx*)> context(spng_ctx_new(SPNG_CTX_ENCODER),
                                                                     spng_ctx_free);
        if (context == nullptr) throw std::bad_alloc();
        Stream stream{sink, nullptr};
        const auto check = [&](int result) {
            if (stream.problem) std::rethrow_exception(stream.problem);
            if (result != 0) throw std::runtime_error(spng_strerror(result));
        };
        check(spng_set_png_stream(context.get(), pass_on, &stream));
        check(spng_set_option(context.get(), SPNG_IMG_COMPRESSION_LEVEL, options_.compression));
        // One filter for all rows: choosing the best for each costs more time than it saves bytes.
        check(spng_set_option(context.get(), SPNG_FILTER_CHOICE, SPNG_FILTER_CHOICE_UP));
        spng_ihdr header{};
        header.width = static_cast<std::uint32_t>(picture.width);
        header.height = static_cast<std::uint32_t>(picture.height);
        header.bit_depth = 8;
        header.color_type = SPNG_COLOR_TYPE_TRUECOLOR;
        check(spng_set_ihdr(context.get(), &header));
        if (picture.encoding == candela::ColorEncoding::srgb) {
            check(spng_set_srgb(context.get(), 0));  // rendering intent: perceptual
        }
        check(spng_encode_image(context.get(), picture.bytes.data(), picture.bytes.size(), SPNG_FMT_PNG,
                                SPNG_ENCODE_FINALIZE));
    }

  private:
    /// Where the bytes go, and what went wrong there: an exception must not pass through C.
    struct Stream {
        candela::ByteSink& sink;
        std::exception_ptr problem;
    };

    static int pass_on(spng_ctx*, void* user, void* bytes, std::size_t count) {
        auto& stream = *static_cast<Stream*>(user);
        try {
            stream.sink.write({static_cast<const std::byte*>(bytes), count});
            return 0;
        } catch (...) {
            stream.problem = std::current_exception();
            return SPNG_IO_ERROR;
        }
    }

    PngOptions options_;
};

constexpr auto k_fields = fields(
    integer(&PngOptions::compression, "compression", 1, "from 0, none, to 9, smallest file").range(0, 9));

constexpr candela::FileFormat k_formats[] = {{"png", "Portable Network Graphics, 8 bits a channel"}};

}  // namespace

CANDELA_PLUGIN(image, Png, k_fields,
               {.title = "PNG",
                .summary = "The everyday format: lossless, small, read by everything.",
                .reference = "W3C (2003), Portable Network Graphics (PNG) Specification, second edition",
                .formats = k_formats})
