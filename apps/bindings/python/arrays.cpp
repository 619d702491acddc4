#include "arrays.h"

#include "candela/kernel/simd_dispatch.h"

namespace candela::python {

namespace {

constexpr py::ssize_t k_float = sizeof(float);

/// Prefetches the rows of the next batch, as many of the `left` rows as this batch has, so that they are in
/// the cache when the model has finished this one.
template <bool is_written>
void prefetch(const float* rows, std::size_t count, std::size_t left) noexcept {
    constexpr std::size_t k_line = 64 / sizeof(float);
    for (std::size_t i = 0; i < 3 * std::min(count, left); i += k_line)
        __builtin_prefetch(rows + i, is_written);
}

/// Splits rows, the vectors of a C-ordered array, into channels.
struct TakeApartLoop {
    CANDELA_BATCH_LOOP static void run(const float* rows, std::size_t count, Vec3Span to) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            to.x[i] = rows[3 * i];
            to.y[i] = rows[3 * i + 1];
            to.z[i] = rows[3 * i + 2];
        }
    }
};

/// The reverse, for the sums of terms.
struct PutTogetherLoop {
    template <class... Terms>
    CANDELA_BATCH_LOOP static void run(std::size_t count, float* rows, Terms... terms) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            rows[3 * i] = (terms.x[i] + ...);
            rows[3 * i + 1] = (terms.y[i] + ...);
            rows[3 * i + 2] = (terms.z[i] + ...);
        }
    }
};

struct AddLoop {
    CANDELA_BATCH_LOOP static void run(std::size_t count, float* sums, const float* a, const float* b) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) sums[i] = a[i] + b[i];
    }
};

}  // namespace

Vectors::Vectors(const Floats& array, const char* name) : data_(reinterpret_cast<const char*>(array.data())) {
    if (array.ndim() != 2 || array.shape(1) != 3)
        throw py::value_error(fmt::format("{} must have the shape (N, 3)", name));
    count_ = static_cast<std::size_t>(array.shape(0));
    step_ = array.strides(0);
    channel_ = array.strides(1);
}

Vectors::Vectors(const std::optional<Floats>& array, const char* name) {
    if (array) *this = Vectors(*array, name);
}

void Vectors::gather(std::size_t first, std::size_t count, BatchVectors& buffer) const noexcept {
    if (is_uniform()) {
        for (std::size_t c = 0; c < 3; ++c) buffer.channels[c].fill(at(0, c));
        buffer.has_one_for_all = true;
    } else if (step_ == 3 * k_float && channel_ == k_float) {
        const float* const rows = reinterpret_cast<const float*>(data_) + 3 * first;
        prefetch<false>(rows + 3 * count, count, count_ - first - count);
        multiversion<TakeApartLoop>(rows, count, buffer.span());
    } else {
        for (std::size_t i = 0; i < count; ++i) buffer.span().set(i, (*this)[first + i]);
    }
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

template <class... Terms>
void Results::write_rows(std::size_t first, std::size_t count, Terms... terms) noexcept {
    float* const rows = channel(first, 0);
    prefetch<true>(rows + 3 * count, count, static_cast<std::size_t>(array_.size()) / 3 - first - count);
    multiversion<PutTogetherLoop>(count, rows, terms...);
}

void Results::write(std::size_t first, std::size_t count, ConstVec3Span vectors) noexcept {
    if (step_ != 1) return write_rows(first, count, vectors);
    std::copy_n(vectors.x, count, channel(first, 0));
    std::copy_n(vectors.y, count, channel(first, 1));
    std::copy_n(vectors.z, count, channel(first, 2));
}

void Results::write(std::size_t first, std::size_t count, ConstVec3Span a, ConstVec3Span b) noexcept {
    if (step_ != 1) return write_rows(first, count, a, b);
    multiversion<AddLoop>(count, channel(first, 0), a.x, b.x);
    multiversion<AddLoop>(count, channel(first, 1), a.y, b.y);
    multiversion<AddLoop>(count, channel(first, 2), a.z, b.z);
}

void for_ranges(std::size_t count, int threads, FunctionRef<std::size_t, std::size_t> body) {
    constexpr std::size_t k_grain = 256 * k_batch_size;
    constexpr double k_milliseconds_per_point = 2e-5;
    with_threads(
        threads, [&] { parallel_for(count, k_grain, body); },
        k_milliseconds_per_point * static_cast<double>(count));
}

}  // namespace candela::python
