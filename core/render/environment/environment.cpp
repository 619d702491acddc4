module;

#include "candela/batch.h"
#include "candela/kernel.h"
#include "candela/multiversion.h"

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

module candela.environment;

namespace candela {

namespace {

using kernel::vec3;

/// `low` for what is no number, as a faulty plugin's directions may yield.
CANDELA_KERNEL_INLINE float within(float x, float low, float high) {
    return x > low ? kernel::min(x, high) : low;
}

CANDELA_KERNEL_INLINE vec3 pixel_at(const float* pixels, std::size_t number) {
    return vec3(pixels[3 * number], pixels[3 * number + 1], pixels[3 * number + 2]);
}

struct LookLoop {
    CANDELA_BATCH_LOOP static void run(const float* pixels, int width, int height, ConstVec3Span towards,
                                       std::size_t count, Vec3Span intensity) {
        constexpr float k_inverse_pi = std::numbers::inv_pi_v<float>;
        const auto columns = static_cast<float>(width), rows = static_cast<float>(height);
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const vec3 d = kernel::load(towards, i);
            const float u = 0.5f + 0.5f * k_inverse_pi * kernel::atan(d.x, -d.z);
            const float v = k_inverse_pi * kernel::acos(kernel::clamp(d.y, -1.0f, 1.0f));
            const float x = within(u * columns - 0.5f, -0.5f, columns - 0.5f);
            const float y = within(v * rows - 0.5f, 0.0f, rows - 1.0f);
            const float left = kernel::floor(x), top = kernel::floor(y);
            const float s = x - left, t = y - top;
            const int column = static_cast<int>(left), row = static_cast<int>(top);
            // Around the back, the last column is beside the first.
            const auto c0 = static_cast<std::size_t>(column < 0 ? width - 1 : column);
            const auto c1 = static_cast<std::size_t>(column + 1 >= width ? 0 : column + 1);
            const std::size_t r0 = static_cast<std::size_t>(row) * static_cast<std::size_t>(width);
            const std::size_t r1 =
                static_cast<std::size_t>(row + 1 >= height ? row : row + 1) * static_cast<std::size_t>(width);
            const vec3 upper = (1.0f - s) * pixel_at(pixels, r0 + c0) + s * pixel_at(pixels, r0 + c1);
            const vec3 lower = (1.0f - s) * pixel_at(pixels, r1 + c0) + s * pixel_at(pixels, r1 + c1);
            kernel::store(intensity, i, (1.0f - t) * upper + t * lower);
        }
    }
};

}  // namespace

Environment::Environment(Rgb everywhere) : everywhere_(everywhere) {}

Environment::Environment(int width, int height, std::vector<float> intensity)
    : width_(width), height_(height), intensity_(std::move(intensity)) {}

Rgb Environment::seen(Vec3 towards) const noexcept {
    Rgb rgb;
    look(1, {&towards.x, &towards.y, &towards.z}, {&rgb.r, &rgb.g, &rgb.b});
    return rgb;
}

void Environment::look(std::size_t count, const ConstVec3Span& towards,
                       const Vec3Span& intensity) const noexcept {
    if (is_uniform()) {
        std::fill_n(intensity.x, count, everywhere_.r);
        std::fill_n(intensity.y, count, everywhere_.g);
        std::fill_n(intensity.z, count, everywhere_.b);
        return;
    }
    multiversion<LookLoop>(intensity_.data(), width_, height_, towards, count, intensity);
}

}  // namespace candela
