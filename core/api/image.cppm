// The interface of image-format plugins.
module;

#include "candela/api.h"

#include <cstddef>
#include <cstdint>
#include <span>

export module candela.image;

export import candela.descriptor;
export import candela.math;

export namespace candela {

/// A finished picture: red, green, blue interleaved, rows from the top, no padding.
struct PictureView {
    int width = 0;
    int height = 0;
    PixelType pixels = PixelType::byte;  // as the format's descriptor asks: `bytes` or `reals` is filled
    ColorEncoding encoding = ColorEncoding::srgb;  // how `bytes` are encoded; `reals` are linear if srgb
    std::span<const std::uint8_t> bytes{};
    std::span<const float> reals{};
};

/// Where an image plugin puts the file's bytes, in order. Owned by the host, which sees to it that nobody
/// ever finds half a file.
class CANDELA_API ByteSink {
  public:
    virtual ~ByteSink();
    /// May throw: a full disk.
    virtual void write(std::span<const std::byte> bytes) = 0;
};

/// Where an image plugin puts a picture that it reads. Owned by the host.
class CANDELA_API PictureSink {
  public:
    virtual ~PictureSink();
    /// Room for the picture: red, green, blue interleaved, rows from the top, no padding. `is_encoded`: the
    /// numbers are 0 to 1, encoded as sRGB; else they are intensities. May throw: too large.
    virtual std::span<float> allocate(int width, int height, bool is_encoded) = 0;
};

/// Writer, and reader if it likes, of one or more file formats. Any thread.
class CANDELA_API ImageFormat : public Instance {
  public:
    ~ImageFormat() override;

    /// Writes `picture` as the format of `extension`, one of the descriptor's. May throw std::exception.
    virtual void write(const PictureView& picture, const char* extension, ByteSink& sink) const = 0;

    /// Reads the picture at `path`, a file of a format that the descriptor says is read. May throw
    /// std::exception.
    virtual void read(const char* path, PictureSink& sink) const;
};

}  // namespace candela
