// Writes frames in the background.
#pragma once

#include <cstddef>
#include <deque>
#include <filesystem>
#include <future>
#include <string>

import candela.plugins;
import candela.render;

/// Writes frames and their records while the next ones are rendered. Writing a small frame is mostly waiting
/// for the disk, and several can wait at the same time. One thread.
class FrameWriter {
  public:
    /// `threads`: for encoding each picture.
    FrameWriter(candela::Registry& registry, candela::OutputFormat format, int threads);
    FrameWriter(const FrameWriter&) = delete;
    FrameWriter& operator=(const FrameWriter&) = delete;
    /// Waits until all frames are written.
    ~FrameWriter();

    /// Takes a copy of the film. Throws the candela::Error of an earlier frame that could not be written.
    void write(const candela::Film& film, const std::filesystem::path& file, const std::string& inputs);
    /// Waits until all frames are written. Throws like write().
    void finish();

  private:
    void wait_for_all_but(std::size_t count);

    candela::Registry& registry_;
    candela::OutputFormat format_;
    int threads_;
    std::deque<std::future<void>> on_their_way_;
};
