// From bytes to a stream of deflate (RFC 1951), in bands that different threads can work on.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

/// Compresses bands of bytes, each without looking at another, so that they make one stream when they are put
/// one after the other. One thread at a time.
class Deflater {
  public:
    /// 0 stores; 1 to 9: from fast to small; 1 to 3 are one. Throws std::bad_alloc.
    static std::unique_ptr<Deflater> create(int compression);

    Deflater() = default;
    Deflater(const Deflater&) = delete;
    Deflater& operator=(const Deflater&) = delete;
    virtual ~Deflater();

    /// The band of less than 2^31 bytes, compressed; valid until the next call. `is_last`: the stream ends
    /// with it. Throws std::bad_alloc.
    virtual std::span<const std::uint8_t> deflate(std::span<const std::uint8_t> band, bool is_last) = 0;
};
