module;

#include "candela/kernel/batch.h"
#include "candela/kernel/kernel.h"
#include "candela/kernel/simd_dispatch.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

module candela.shading;

namespace candela {

namespace {

using kernel::vec3;

/// `low` for NaN, which a faulty plugin's directions may yield.
CANDELA_KERNEL_INLINE float within(float x, float low, float high) {
    return x > low ? kernel::min(x, high) : low;
}

constexpr std::size_t k_group_size = 64;

/// The four pixels around each direction, and its position between them.
struct BilinearFootprints {
    std::array<std::array<std::uint32_t, k_group_size>, 4> pixel;  // upper left, upper right, lower left …
    std::array<float, k_group_size> across, down;
};

struct FootprintLoop {
    CANDELA_BATCH_LOOP static void run(int width, int height, ConstVec3Span towards, std::size_t count,
                                       BilinearFootprints* footprints) {
        constexpr float k_inverse_pi = std::numbers::inv_pi_v<float>;
        const auto columns = static_cast<float>(width), rows = static_cast<float>(height);
        BilinearFootprints& p = *footprints;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const vec3 d = kernel::load(towards, i);
            const float u = 0.5f + 0.5f * k_inverse_pi * kernel::atan(d.x, -d.z);
            const float v = k_inverse_pi * kernel::acos(kernel::clamp(d.y, -1.0f, 1.0f));
            const float x = within(u * columns - 0.5f, -0.5f, columns - 0.5f);
            const float y = within(v * rows - 0.5f, 0.0f, rows - 1.0f);
            const float left = kernel::floor(x), top = kernel::floor(y);
            const int column = static_cast<int>(left), row = static_cast<int>(top);
            // Wraps around at the back: the last column adjoins the first.
            const int c0 = column < 0 ? width - 1 : column, c1 = column + 1 >= width ? 0 : column + 1;
            const auto upper = static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(width);
            const auto lower = static_cast<std::uint32_t>(row + 1 >= height ? row : row + 1) *
                               static_cast<std::uint32_t>(width);
            p.pixel[0][i] = upper + static_cast<std::uint32_t>(c0);
            p.pixel[1][i] = upper + static_cast<std::uint32_t>(c1);
            p.pixel[2][i] = lower + static_cast<std::uint32_t>(c0);
            p.pixel[3][i] = lower + static_cast<std::uint32_t>(c1);
            p.across[i] = x - left;
            p.down[i] = y - top;
        }
    }
};

/// A picture's pixels, each read together with a fourth number, which is ignored.
class Pixels {
  public:
    explicit Pixels(const std::vector<float>& channels)
        : first_(channels.data()), last_(channels.size() / 3 - 1) {
        std::copy_n(&channels[3 * last_], 3, last_pixel_.data());
    }

    Eigen::Map<const Eigen::Array4f> operator[](std::size_t number) const {
        // Nothing may be read past the last one.
        return Eigen::Map<const Eigen::Array4f>(number < last_ ? first_ + 3 * number : last_pixel_.data());
    }

  private:
    const float* first_;
    std::size_t last_;
    std::array<float, 4> last_pixel_{};
};

}  // namespace

EnvironmentMap::EnvironmentMap(Rgb everywhere)
    : everywhere_(everywhere), max_intensity_(std::max({everywhere.r, everywhere.g, everywhere.b})) {}

EnvironmentMap::EnvironmentMap(int width, int height, std::vector<float> intensity)
    : max_intensity_(std::ranges::max(intensity)),
      width_(width),
      height_(height),
      intensity_(std::move(intensity)) {}

Rgb EnvironmentMap::seen(Vec3 towards) const noexcept {
    Rgb rgb;
    look(1, {&towards.x, &towards.y, &towards.z}, {&rgb.r, &rgb.g, &rgb.b});
    return rgb;
}

void EnvironmentMap::look(std::size_t count, const ConstVec3Span& towards,
                          const Vec3Span& intensity) const noexcept {
    if (is_uniform()) {
        std::fill_n(intensity.x, count, everywhere_.r);
        std::fill_n(intensity.y, count, everywhere_.g);
        std::fill_n(intensity.z, count, everywhere_.b);
        return;
    }
    const Pixels pixels(intensity_);
    BilinearFootprints footprints;
    for (std::size_t first = 0; first < count; first += k_group_size) {
        const std::size_t here = std::min(k_group_size, count - first);
        multiversion<FootprintLoop>(width_, height_, towards.from(first), here, &footprints);
        for (std::size_t i = 0; i < here; ++i) {
            const auto pixel = [&](std::size_t corner) { return pixels[footprints.pixel[corner][i]]; };
            const float across = footprints.across[i], down = footprints.down[i];
            const Eigen::Array4f upper = (1 - across) * pixel(0) + across * pixel(1),
                                 lower = (1 - across) * pixel(2) + across * pixel(3),
                                 seen = (1 - down) * upper + down * lower;
            intensity.set(first + i, {seen[0], seen[1], seen[2]});
        }
    }
}

}  // namespace candela
