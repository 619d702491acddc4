// Memory that is written before it is read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

/// Grows, and keeps its memory for the next band. It is not filled with zeros, so that untouched pages cost
/// nothing.
class Scratch {
  public:
    /// Its contents are undefined; valid until the next call.
    std::span<std::uint8_t> of_size(std::size_t size) {
        if (size > size_) {
            bytes_ = std::make_unique_for_overwrite<std::uint8_t[]>(size);
            size_ = size;
        }
        return {bytes_.get(), size};
    }

  private:
    std::unique_ptr<std::uint8_t[]> bytes_;
    std::size_t size_ = 0;
};
