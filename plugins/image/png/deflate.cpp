#include "deflate.h"

#include <isa-l/igzip_lib.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <new>
#include <stdexcept>

#include "scratch.h"

namespace {

/// The largest size of the output of `deflate`: the band itself, framed as stored blocks.
std::size_t room_for(std::span<const std::uint8_t> band) { return band.size() + band.size() / 8 + 64; }

[[noreturn]] void fail() { throw std::logic_error("a band cannot be compressed"); }

/// Several times faster than zlib.
class IsalDeflater final : public Deflater {
  public:
    // isa-l's own initialisation leaves parts of the stream unset. The buffers at its end are filled before
    // they are read.
    IsalDeflater() {
        std::memset(&stream_, 0, offsetof(isal_zstream, internal_state) + offsetof(isal_zstate, buffer));
    }

    std::span<const std::uint8_t> deflate(std::span<const std::uint8_t> band, bool is_last) override {
        const std::span<std::uint8_t> room = room_.of_size(room_for(band));
        const auto start = band.first(std::min(band.size(), k_window));
        const auto rest = band.subspan(start.size());
        const auto compressed = room.subspan(store(start, room));
        isal_deflate_init(&stream_);
        stream_.level = 1;
        // Looks for runs only. Rows minus their neighbours are mostly runs, and other matches that isa-l
        // finds cost more bits than they save: files grow by a tenth to a quarter.
        stream_.hist_bits = std::bit_width(k_window) - 1;
        stream_.level_buf = workspace_.get();
        stream_.level_buf_size = k_workspace;
        // Without history, isa-l 2.30 begins by hashing a register that it has not set, which holds the
        // stream's address: one file in some hundreds had other bytes.
        if (isal_deflate_set_dict(&stream_, const_cast<std::uint8_t*>(start.data()),
                                  static_cast<std::uint32_t>(start.size())) != COMP_OK)
            fail();
        stream_.next_in = const_cast<std::uint8_t*>(rest.data());
        stream_.avail_in = static_cast<std::uint32_t>(rest.size());
        stream_.next_out = compressed.data();
        stream_.avail_out = static_cast<std::uint32_t>(compressed.size());
        stream_.end_of_stream = is_last ? 1 : 0;
        stream_.flush = is_last ? NO_FLUSH : SYNC_FLUSH;
        if (isal_deflate(&stream_) != COMP_OK || stream_.avail_in != 0 || stream_.avail_out == 0) fail();
        return room.first(room.size() - stream_.avail_out);
    }

  private:
    /// Writes an uncompressed block (RFC 1951, 3.2.4) that is not the last. Returns the number of bytes
    /// written.
    static std::size_t store(std::span<const std::uint8_t> bytes, std::span<std::uint8_t> out) {
        const auto size = static_cast<std::uint16_t>(bytes.size());
        const auto inverse = static_cast<std::uint16_t>(~size);
        const std::uint8_t head[] = {0, static_cast<std::uint8_t>(size), static_cast<std::uint8_t>(size >> 8),
                                     static_cast<std::uint8_t>(inverse),
                                     static_cast<std::uint8_t>(inverse >> 8)};
        std::ranges::copy(bytes, std::ranges::copy(head, out.begin()).out);
        return std::size(head) + bytes.size();
    }

    static constexpr std::size_t k_window = 2;  // how far back a match may reach
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
