#include "deflate.h"

#include <isa-l/igzip_lib.h>
#include <zlib.h>

#include <cstddef>
#include <cstring>
#include <new>
#include <stdexcept>

#include "scratch.h"

namespace {

/// What the output of `deflate` may take: the band itself with the frames of stored blocks.
std::size_t room_for(std::span<const std::uint8_t> band) { return band.size() + band.size() / 8 + 64; }

[[noreturn]] void fail() { throw std::logic_error("a band could not be compressed"); }

/// Several times faster than zlib.
class IsalDeflater final : public Deflater {
  public:
    // isa-l's own initialisation leaves parts of the stream unset. The buffers at its end are for streams of
    // several calls.
    IsalDeflater() {
        std::memset(&stream_, 0, offsetof(isal_zstream, internal_state) + offsetof(isal_zstate, buffer));
    }

    std::span<const std::uint8_t> deflate(std::span<const std::uint8_t> band, bool is_last) override {
        const std::span<std::uint8_t> room = room_.of_size(room_for(band));
        isal_deflate_stateless_init(&stream_);
        stream_.level = 1;
        // Looks for runs only. Rows minus their neighbours are mostly runs, and other matches that isa-l
        // finds cost more bits than they save: files grow by a tenth to a quarter.
        stream_.hist_bits = 1;
        stream_.level_buf = workspace_.get();
        stream_.level_buf_size = k_workspace;
        stream_.next_in = const_cast<std::uint8_t*>(band.data());
        stream_.avail_in = static_cast<std::uint32_t>(band.size());
        stream_.next_out = room.data();
        stream_.avail_out = static_cast<std::uint32_t>(room.size());
        stream_.end_of_stream = is_last ? 1 : 0;
        stream_.flush = is_last ? NO_FLUSH : FULL_FLUSH;
        if (isal_deflate_stateless(&stream_) != COMP_OK || stream_.avail_in != 0) fail();
        return room.first(stream_.total_out);
    }

  private:
    static constexpr std::uint32_t k_workspace = ISAL_DEF_LVL1_SMALL;
    std::unique_ptr<std::uint8_t[]> workspace_ = std::make_unique_for_overwrite<std::uint8_t[]>(k_workspace);
    isal_zstream stream_;
    Scratch room_;
};

class ZlibDeflater final : public Deflater {
  public:
    explicit ZlibDeflater(int level) {
        constexpr int k_raw = -15;  // bits of the window; negative: without a zlib header
        if (deflateInit2(&stream_, level, Z_DEFLATED, k_raw, 8, Z_DEFAULT_STRATEGY) != Z_OK)
            throw std::bad_alloc();
    }
    ZlibDeflater(const ZlibDeflater&) = delete;
    ZlibDeflater& operator=(const ZlibDeflater&) = delete;
    ~ZlibDeflater() override { deflateEnd(&stream_); }

    std::span<const std::uint8_t> deflate(std::span<const std::uint8_t> band, bool is_last) override {
        const std::span<std::uint8_t> room = room_.of_size(room_for(band));
        deflateReset(&stream_);
        stream_.next_in = const_cast<std::uint8_t*>(band.data());
        stream_.avail_in = static_cast<uInt>(band.size());
        stream_.next_out = room.data();
        stream_.avail_out = static_cast<uInt>(room.size());
        const int result = ::deflate(&stream_, is_last ? Z_FINISH : Z_SYNC_FLUSH);
        if (result != (is_last ? Z_STREAM_END : Z_OK) || stream_.avail_in != 0 || stream_.avail_out == 0)
            fail();
        return room.first(stream_.total_out);
    }

  private:
    z_stream stream_{};
    Scratch room_;
};

}  // namespace

Deflater::~Deflater() = default;

std::unique_ptr<Deflater> Deflater::create(int compression) {
    // Up to level three, zlib's files are larger than isa-l's.
    if (compression >= 1 && compression <= 3) return std::make_unique<IsalDeflater>();
    return std::make_unique<ZlibDeflater>(compression);
}
