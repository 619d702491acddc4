// What an image plugin may implement beside ImageFormat, so that pictures need not fit into memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "candela/api.h"
#include "candela/image.h"

namespace candela {

/// A picture whose rows are made when they are asked for, from the top. Owned by the host.
class CANDELA_API PictureRows {
  public:
    virtual ~PictureRows();
    /// The next `count` rows, at least 1, or as many as there are left: a view of their height. It is valid
    /// until the next call. May throw.
    virtual PictureView next(int count) = 0;
};

/// Rows of a picture that is in memory.
class CANDELA_API ViewedRows final : public PictureRows {
  public:
    /// The pixels must outlive this.
    explicit ViewedRows(const PictureView& picture);
    ~ViewedRows() override;
    PictureView next(int count) override;

  private:
    PictureView picture_;
    int done_ = 0;
};

/// A ByteSink whose file may be written in any order, for formats whose beginning depends on their end.
class CANDELA_API RandomAccessSink : public ByteSink {
  public:
    ~RandomAccessSink() override;
    /// `offset`: from the beginning of the file. May throw.
    virtual void write_at(std::uint64_t offset, std::span<const std::byte> bytes) = 0;
};

/// Writes one or more formats row by row. To be a base of an ImageFormat's class, which the host asks for.
/// Any thread.
class CANDELA_API RowFormat {
  public:
    virtual ~RowFormat();

    /// Whether the format of an extension can be written so.
    virtual bool writes_rows(const char* extension) const = 0;

    /// Writes the bytes that ImageFormat::write() writes for the same pixels. `whole`: the picture without
    /// its pixels. The sink is a RandomAccessSink if the file allows that. May throw std::exception.
    virtual void write_rows(const PictureView& whole, PictureRows& rows, const char* extension,
                            ByteSink& sink) const = 0;
};

}  // namespace candela
