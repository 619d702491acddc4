// Turns bytes into a deflate stream (RFC 1951), in bands that different threads can process.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

/// Compresses bands of bytes independently of one another, such that their concatenation is one stream. One
/// thread at a time.
class Deflater {
  public:
    /// 0 stores; 1 to 9 range from fast to small; 1 to 3 are the same. Throws std::bad_alloc.
    static std::unique_ptr<Deflater> create(int compression);

    Deflater() = default;
    Deflater(const Deflater&) = delete;
    Deflater& operator=(const Deflater&) = delete;
    virtual ~Deflater();

    /// Compresses a band of less than 2^31 bytes. The result is valid until the next call. `is_last`: it ends
    /// the stream. Throws std::bad_alloc.
    virtual std::span<const std::uint8_t> deflate(std::span<const std::uint8_t> band, bool is_last) = 0;
};
