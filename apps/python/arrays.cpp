#include "arrays.h"

namespace candela::python {

namespace {

constexpr py::ssize_t k_float = sizeof(float);

// In one pass each, which the compiler turns into loads, shuffles and stores of whole vectors.

void take_apart(const float* __restrict from, std::size_t count, float* __restrict x, float* __restrict y,
                float* __restrict z) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
        x[i] = from[3 * i];
        y[i] = from[3 * i + 1];
        z[i] = from[3 * i + 2];
    }
}

void put_together(ConstVec3Span a, ConstVec3Span b, std::size_t count, float* __restrict to) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
        to[3 * i] = a.x[i] + b.x[i];
        to[3 * i + 1] = a.y[i] + b.y[i];
        to[3 * i + 2] = a.z[i] + b.z[i];
    }
}

void add(const float* __restrict a, const float* __restrict b, std::size_t count,
         float* __restrict to) noexcept {
    for (std::size_t i = 0; i < count; ++i) to[i] = a[i] + b[i];
}

}  // namespace

void BatchVectors::clear() noexcept {
    for (float* const channel : {x, y, z}) std::fill_n(channel, k_batch_size, 0.0f);
}

Vectors::Vectors(const Floats& array, const char* name)
    : data_(reinterpret_cast<const char*>(array.data())), count_(0), step_(0), channel_(0) {
    if (array.ndim() != 2 || array.shape(1) != 3)
        throw py::value_error(fmt::format("{} has to have the shape (N, 3)", name));
    count_ = static_cast<std::size_t>(array.shape(0));
    step_ = array.strides(0);
    channel_ = array.strides(1);
}

Vectors::Vectors(const std::optional<Floats>& array, const char* name) {
    if (array) *this = Vectors(*array, name);
}

float Vectors::at(std::size_t i, std::size_t channel) const noexcept {
    return *reinterpret_cast<const float*>(data_ + static_cast<py::ssize_t>(i) * step_ +
                                           static_cast<py::ssize_t>(channel) * channel_);
}

Vec3 Vectors::operator[](std::size_t i) const noexcept { return {at(i, 0), at(i, 1), at(i, 2)}; }

ConstVec3Span Vectors::read(std::size_t first, std::size_t count, BatchVectors& buffer) const noexcept {
    if (data_ == nullptr) return {};
    const char* const from = data_ + static_cast<py::ssize_t>(first) * step_;
    if (step_ == k_float) {
        const auto channel = [&](py::ssize_t c) {
            return reinterpret_cast<const float*>(from + c * channel_);
        };
        return {channel(0), channel(1), channel(2)};
    }
    if (is_uniform()) {
        if (buffer.has_one_for_all) return buffer.span();
        std::fill_n(buffer.x, k_batch_size, at(0, 0));
        std::fill_n(buffer.y, k_batch_size, at(0, 1));
        std::fill_n(buffer.z, k_batch_size, at(0, 2));
        buffer.has_one_for_all = true;
    } else if (step_ == 3 * k_float && channel_ == k_float) {
        take_apart(reinterpret_cast<const float*>(from), count, buffer.x, buffer.y, buffer.z);
    } else {
        for (std::size_t i = 0; i < count; ++i) buffer.span().set(i, (*this)[first + i]);
    }
    return buffer.span();
}

void require_same_count(std::initializer_list<const Vectors*> all) {
    std::optional<std::size_t> count;
    for (const Vectors* const vectors : all) {
        if (!*vectors) continue;
        if (count && *count != vectors->count())
            throw py::value_error("arrays differ in their number of vectors");
        count = vectors->count();
    }
}

Results::Results(std::size_t count, Layout layout)
    : step_(layout == Layout::interleaved ? 3 : 1),
      apart_(layout == Layout::interleaved ? 1 : count),
      array_({static_cast<py::ssize_t>(count), py::ssize_t{3}},
             {static_cast<py::ssize_t>(step_) * k_float, static_cast<py::ssize_t>(apart_) * k_float}),
      data_(array_.mutable_data()) {}

void Results::write(std::size_t first, std::size_t count, ConstVec3Span vectors) noexcept {
    const float* const from[3] = {vectors.x, vectors.y, vectors.z};
    for (std::size_t c = 0; c < 3; ++c) {
        float* const to = channel(first, c);
        for (std::size_t i = 0; i < count; ++i) to[i * step_] = from[c][i];
    }
}

void Results::write(std::size_t first, std::size_t count, ConstVec3Span a, ConstVec3Span b) noexcept {
    if (step_ != 1) return put_together(a, b, count, channel(first, 0));
    add(a.x, b.x, count, channel(first, 0));
    add(a.y, b.y, count, channel(first, 1));
    add(a.z, b.z, count, channel(first, 2));
}

void for_ranges(std::size_t count, int threads, FunctionRef<std::size_t, std::size_t> body) {
    constexpr std::size_t k_grain = 64 * k_batch_size;
    constexpr double k_milliseconds_per_point = 2e-5;
    with_threads(
        threads, [&] { parallel_for(count, k_grain, body); },
        k_milliseconds_per_point * static_cast<double>(count));
}

}  // namespace candela::python
