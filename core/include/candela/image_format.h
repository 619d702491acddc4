// The interface of image-format plugins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "candela/math.h"
#include "candela/plugin/descriptor.h"
#include "candela/plugin/export.h"

namespace candela {

/// A finished picture: red, green, blue interleaved, rows from the top, no padding between or after rows.
struct ImageView {
    int width = 0;
    int height = 0;
    PixelType pixels = PixelType::byte;            // the descriptor's choice: fills `bytes` or `reals`
    ColorEncoding encoding = ColorEncoding::srgb;  // how `bytes` are encoded; `reals` are linear if srgb
    std::span<const std::uint8_t> bytes{};
    std::span<const float> reals{};
};

/// One number per pixel of a picture with layers, rows from the top, no padding.
struct ImageChannel {
    const char* name = "";  // "R", or with the layer's name as a prefix: "diffuse.R"
    std::span<const float> values{};
};

/// Receives the bytes of the file that an image plugin writes, in order. Owned by the host, which writes the
/// file atomically.
class CANDELA_EXPORT ByteSink {
  public:
    virtual ~ByteSink();
    /// May throw, for instance when the disk is full.
    virtual void write(std::span<const std::byte> bytes) = 0;
};

/// Receives the picture that an image plugin reads. Owned by the host.
class CANDELA_EXPORT ImageSink {
  public:
    virtual ~ImageSink();
    /// Returns memory for the picture: red, green, blue interleaved, rows from the top, no padding.
    /// `is_encoded`: the values are sRGB-encoded, 0 to 1; otherwise they are intensities. May throw if the
    /// picture is too large.
    virtual std::span<float> allocate(int width, int height, bool is_encoded) = 0;
    /// Called after allocate() by plugins whose format has opacity. Returns memory for the opacity of each
    /// pixel, 0 to 1, filled with 1; empty if the caller does not need it.
    virtual std::span<float> allocate_opacity();
};

/// Writes, and optionally reads, one or more file formats. Any thread.
class CANDELA_EXPORT ImageFormat : public Instance {
  public:
    ~ImageFormat() override;

    /// Writes `picture` in the format of `extension`, one of the descriptor's. May throw std::exception.
    virtual void write(const ImageView& image, const char* extension, ByteSink& sink) const = 0;

    /// Writes a picture with any number of channels, in a format that the descriptor declares to have layers.
    /// The first three are the red, green and blue of the picture itself, all values are linear and unbounded
    /// (infinity included), and names are unique UTF-8. May throw std::exception.
    virtual void write_layers(int width, int height, std::span<const ImageChannel> channels,
                              const char* extension, ByteSink& sink) const;

    /// Reads the picture at `path`, in a format that the descriptor declares as readable. May throw
    /// std::exception.
    virtual void read(const char* path, ImageSink& sink) const;
};

}  // namespace candela
