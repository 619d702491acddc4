module;

#include "candela/plugin/export.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

export module candela.render:film;

import candela.api;
import candela.plugins;
import candela.util;

export namespace candela {

/// Rows of a picture, from `first` up to but not including `end`.
struct RowRange {
    int first = 0;
    int end = 0;

    inline int count() const noexcept { return end - first; }
    friend bool operator==(const RowRange&, const RowRange&) = default;
};

/// How intensities become the values of an 8-bit picture: exposed, then the tone curve, then clamped and
/// encoded.
struct DisplayTransform {
    DisplayTransform() = default;
    // NOLINTNEXTLINE(google-explicit-constructor): most pictures have only an encoding
    CANDELA_EXPORT DisplayTransform(ColorEncoding color_encoding, float exposure_factor = 1,
                                    ToneCurve curve = ToneCurve::none)
        : encoding(color_encoding), exposure(exposure_factor), tone(curve) {}

    ColorEncoding encoding = ColorEncoding::srgb;
    float exposure = 1;
    ToneCurve tone = ToneCurve::none;

    friend bool operator==(const DisplayTransform&, const DisplayTransform&) = default;
};

/// An intensity as an 8-bit picture shows it: before clamping and encoding, and after it, 0 to 1.
CANDELA_EXPORT Rgb toned(Rgb intensity, const DisplayTransform& transform) noexcept;
CANDELA_EXPORT Rgb displayed(Rgb intensity, const DisplayTransform& transform) noexcept;

/// The picture being made, with pixels in the form of its file format: 8-bit, as `transform` shows them, or
/// 32-bit float, as computed.
class CANDELA_EXPORT Film {
  public:
    /// Throws Error if memory is insufficient.
    Film(int width, int height, PixelType pixels, const DisplayTransform& transform);
    /// Only these rows of a picture of that size.
    Film(int width, int height, PixelType pixels, const DisplayTransform& transform, RowRange rows);

    int width() const noexcept { return width_; }
    /// The height of the whole picture.
    int height() const noexcept { return height_; }
    RowRange rows() const noexcept { return rows_; }

    /// Stores a rectangle of intensities, with rows `stride` apart. Rows outside the film are skipped.
    /// Different threads may store different pixels at the same time.
    void store(int x, int y, int width, int height, ConstVec3Span intensity, int stride);

    /// Stores one intensity in all pixels of a rectangle, like store().
    void fill(int x, int y, int width, int height, Rgb intensity);

    /// Copies another film's pixels unchanged, its upper left corner to (x, y). Both are whole pictures with
    /// pixels of the same type, and `other` lies within this one.
    void paste(int x, int y, const Film& other);

    /// All rows of the film.
    ImageView view() const noexcept;

  private:
    std::size_t index_of(int x, int y) const noexcept;

    int width_;
    int height_;
    RowRange rows_;
    PixelType pixels_;
    DisplayTransform transform_;
    AlignedVector<std::uint8_t> bytes_;
    AlignedVector<float> reals_;
};

/// The plugin that writes a picture, and the form in which it requires the pixels.
struct OutputFormat {
    std::string plugin;
    std::string extension;
    PixelType pixels = PixelType::byte;
    bool has_layers = false;
    ParamSet parameters{};  // of the plugin
};

/// The format of a path, by its extension, with the plugin's default parameters; "-", standard output, is
/// PNG. Throws Error for an extension that no plugin writes.
CANDELA_EXPORT OutputFormat format_of(const std::filesystem::path& path, Registry& registry);

/// Writes the picture atomically, through an OutputFile; `existing` and `links` say how to treat an existing
/// file and a link.
/// Plugins that encode on several threads use those of with_threads(). Throws Error.
CANDELA_EXPORT void write_image(const Film& film, const OutputFormat& format,
                                const std::filesystem::path& path, Registry& registry,
                                Existing existing = Existing::replaced, Links links = Links::followed);

/// Like the above, into a file that the caller finishes.
CANDELA_EXPORT void write_image(const Film& film, const OutputFormat& format, OutputFile& file,
                                Registry& registry);

/// Whether write_rows() can write the format without the whole picture in memory.
CANDELA_EXPORT bool can_write_rows(const OutputFormat& format, Registry& registry);

/// Writes the same bytes as write_image(), for a picture that need not be in memory. `whole`: the picture
/// without its pixels. Throws Error.
CANDELA_EXPORT void write_rows(const ImageView& whole, ImageRows& rows, const OutputFormat& format,
                               const std::filesystem::path& path, Registry& registry,
                               Existing existing = Existing::replaced);

/// Writes a picture with layers in the same way, in a format that supports them.
CANDELA_EXPORT void write_layers(int width, int height, std::span<const ImageChannel> channels,
                                 const OutputFormat& format, const std::filesystem::path& path,
                                 Registry& registry, Existing existing = Existing::replaced);

}  // namespace candela
