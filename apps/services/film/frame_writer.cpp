#include "film/frame_writer.h"

#include <algorithm>
#include <utility>

#include "film/render_cache.h"

import candela.api;
import candela.util;

namespace fs = std::filesystem;

namespace {

/// As many frames as the disk takes at once, in no more memory than one large frame.
std::size_t most_on_their_way(const candela::Film& film) {
    constexpr std::size_t k_most = 8, k_bytes = std::size_t{1} << 27;
    const candela::ImageView view = film.view();
    return std::clamp(k_bytes / (view.bytes.size_bytes() + view.reals.size_bytes() + 1), std::size_t{1},
                      k_most);
}

}  // namespace

FrameWriter::FrameWriter(candela::Registry& registry, candela::OutputFormat format, int threads)
    : registry_(registry), format_(std::move(format)), threads_(threads) {}

// A future's destructor waits for its work.
FrameWriter::~FrameWriter() = default;

void FrameWriter::write(const candela::Film& film, const fs::path& file, const std::string& inputs) {
    wait_for_all_but(most_on_their_way(film) - 1);
    on_their_way_.push_back(std::async(std::launch::async, [this, copy = film, file, inputs] {
        constexpr double k_milliseconds = 3e-6;  // per pixel, for encoding
        candela::with_threads(
            threads_,
            [&] {
                candela::write_image(copy, format_, file, registry_, candela::Existing::replaced,
                                     candela::Links::not_followed);
            },
            k_milliseconds * copy.width() * copy.height());
        record(file, inputs, candela::Links::not_followed);
    }));
}

void FrameWriter::finish() { wait_for_all_but(0); }

void FrameWriter::wait_for_all_but(std::size_t count) {
    while (on_their_way_.size() > count) {
        std::future<void> first = std::move(on_their_way_.front());
        on_their_way_.pop_front();
        first.get();
    }
}
