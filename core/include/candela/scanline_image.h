// An extension of ImageFormat (see extensions.h), for pictures that do not fit into memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "candela/image_format.h"
#include "candela/plugin/export.h"

namespace candela {

/// A picture whose rows are made on request, from the top. Owned by the host.
class CANDELA_EXPORT ImageRows {
  public:
    virtual ~ImageRows();
    /// Returns the next `count` rows (at least 1), or those that are left, as a picture of that height. Valid
    /// until the next call. May throw.
    virtual ImageView next(int count) = 0;
};

/// Rows of a picture that is in memory.
class CANDELA_EXPORT ViewedRows final : public ImageRows {
  public:
    /// The pixels must outlive this.
    explicit ViewedRows(const ImageView& image);
    ~ViewedRows() override;
    ImageView next(int count) override;

  private:
    ImageView image_;
    int done_ = 0;
};

/// A ByteSink whose file may be written in any order, for formats whose beginning depends on their end.
class CANDELA_EXPORT RandomAccessSink : public ByteSink {
  public:
    ~RandomAccessSink() override;
    /// `offset`: from the beginning of the file. May throw.
    virtual void write_at(std::uint64_t offset, std::span<const std::byte> bytes) = 0;
};

/// An ImageFormat that writes one or more formats row by row. Any thread.
class CANDELA_EXPORT ScanlineImageFormat {
  public:
    virtual ~ScanlineImageFormat();

    /// Whether the format of that extension can be written row by row.
    virtual bool writes_rows(const char* extension) const = 0;

    /// Writes the same bytes as ImageFormat::write() for the same pixels. `whole`: the picture without its
    /// pixels. The sink is a RandomAccessSink if the file allows it. May throw std::exception.
    virtual void write_rows(const ImageView& whole, ImageRows& rows, const char* extension,
                            ByteSink& sink) const = 0;
};

}  // namespace candela
