// NumPy arrays as batches of vectors.
#pragma once

#include "binding.h"

import candela.api;

namespace candela::python {

/// Numbers with any strides.
using Floats = py::array_t<float, py::array::forcecast>;

/// The number of points passed to a model at a time: few enough that their gathered data and the arrays
/// passing through it fit in the first-level cache.
inline constexpr std::size_t k_batch_size = 64;

struct BatchVectors {
    alignas(64) std::array<std::array<float, k_batch_size>, 3> channels;
    bool has_one_for_all = false;  // all of them are the array's only vector

    Vec3Span span() noexcept { return {channels[0].data(), channels[1].data(), channels[2].data()}; }
    void clear() noexcept { channels = {}; }
};

/// The memory layout of an array's vectors.
enum class Layout : bool { interleaved, channels_apart };

/// An array of shape (count, 3), or none. Does not own it.
class Vectors {
  public:
    Vectors() = default;
    /// `name` is for the ValueError thrown for another shape.
    Vectors(const Floats& array, const char* name);
    Vectors(const std::optional<Floats>& array, const char* name);

    explicit operator bool() const noexcept { return data_ != nullptr; }
    std::size_t count() const noexcept { return count_; }
    Layout layout() const noexcept {
        return step_ == sizeof(float) ? Layout::channels_apart : Layout::interleaved;
    }
    /// Whether all vectors are the same one.
    bool is_uniform() const noexcept { return step_ == 0; }
    Vec3 operator[](std::size_t i) const noexcept { return {at(i, 0), at(i, 1), at(i, 2)}; }
    /// The vectors of a batch: in place if each channel is contiguous, otherwise copied to `buffer`. Null if
    /// there are none.
    ConstVec3Span read(std::size_t first, std::size_t count, BatchVectors& buffer) const noexcept {
        if (data_ == nullptr) return {};
        if (layout() == Layout::channels_apart)
            return {channel(first, 0), channel(first, 1), channel(first, 2)};
        if (!buffer.has_one_for_all) gather(first, count, buffer);
        const Vec3Span gathered = buffer.span();
        // Numbers that are the same in all channels need only one channel, which leaves more of the cache to
        // others.
        return channel_ == 0 ? ConstVec3Span{gathered.x, gathered.x, gathered.x} : gathered;
    }

  private:
    /// The address of a number.
    const float* channel(std::size_t i, std::size_t c) const noexcept {
        return reinterpret_cast<const float*>(data_ + static_cast<py::ssize_t>(i) * step_ +
                                              static_cast<py::ssize_t>(c) * channel_);
    }
    float at(std::size_t i, std::size_t c) const noexcept { return *channel(i, c); }
    void gather(std::size_t first, std::size_t count, BatchVectors& buffer) const noexcept;

    const char* data_ = nullptr;
    std::size_t count_ = 0;
    py::ssize_t step_ = 0, channel_ = 0;  // bytes
};

/// Throws ValueError unless all non-empty ones have the same number of vectors.
void require_same_count(std::initializer_list<const Vectors*> all);

/// A new array of shape (count, 3).
class Results {
  public:
    explicit Results(std::size_t count, Layout layout = Layout::interleaved);

    void write(std::size_t first, std::size_t count, ConstVec3Span vectors) noexcept;
    /// Writes the sums.
    void write(std::size_t first, std::size_t count, ConstVec3Span a, ConstVec3Span b) noexcept;
    Floats take() { return std::move(array_); }

  private:
    template <class... Terms>
    void write_rows(std::size_t first, std::size_t count, Terms... terms) noexcept;

    /// The address of the first vector's channel; the others are step_ apart.
    float* channel(std::size_t first, std::size_t c) const noexcept {
        return data_ + first * step_ + c * apart_;
    }

    std::size_t step_, apart_;  // in numbers
    Floats array_;
    float* data_;
};

/// Calls `body(begin, end)` for ranges of points on as many threads as with_threads() chooses. Runs without
/// Python's lock.
void for_ranges(std::size_t count, int threads, FunctionRef<std::size_t, std::size_t> body);

/// Like for_ranges(), calls `body(buffers, first, size)` for all batches, with buffers shared by one thread's
/// batches.
template <class Buffers, class Body>
void for_batches(std::size_t count, int threads, const Body& body) {
    for_ranges(count, threads, [&](std::size_t begin, std::size_t end) {
        Buffers buffers;
        for (std::size_t first = begin; first < end; first += k_batch_size)
            body(buffers, first, std::min(k_batch_size, end - first));
    });
}

}  // namespace candela::python
