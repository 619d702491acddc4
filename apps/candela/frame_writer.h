// Frames on their way to the disk.
#pragma once

#include <cstddef>
#include <deque>
#include <filesystem>
#include <future>
#include <string>

import candela.film;
import candela.registry;

/// Writes frames and their records while the next ones are rendered: to write a small one is mostly to wait
/// for the disk, and several wait no longer than one. One thread.
class FrameWriter {
  public:
    /// `threads`: that each picture is encoded by.
    FrameWriter(candela::Registry& registry, candela::PictureFormat format, int threads);
    FrameWriter(const FrameWriter&) = delete;
    FrameWriter& operator=(const FrameWriter&) = delete;
    /// Waits for all.
    ~FrameWriter();

    /// Takes a copy of the film. Throws what went wrong with a frame before, a candela::Error.
    void write(const candela::Film& film, const std::filesystem::path& file, const std::string& inputs);
    /// Waits until all are written. Throws likewise.
    void finish();

  private:
    void wait_for_all_but(std::size_t count);

    candela::Registry& registry_;
    candela::PictureFormat format_;
    int threads_;
    std::deque<std::future<void>> on_their_way_;
};
