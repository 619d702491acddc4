// Arbitrary bytes as the photometric file of light/ies.
#include <array>
#include <cmath>
#include <exception>

#include "robustness/fuzz/fuzz.h"
#include "support/plugins.h"

using candela::Vec3;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto file = fuzz::written("lamp.ies", fuzz::text_of(data, size));
    try {
        const auto light = instance<candela::Light>(
            "ies", {{"file", file.string()}, {"position", Vec3{}}, {"direction", Vec3{0, -1, 0}}});
        constexpr std::array k_x = {0.0f, 1.0f, -0.3f, 0.0f, 1e-6f}, k_y = {-1.0f, 0.0f, 0.5f, 2.0f, 0.0f},
                             k_z = {0.0f, 0.0f, 0.7f, 0.0f, 0.0f};
        std::array<std::array<float, k_x.size()>, 9> out{};
        const auto span = [&](std::size_t i) {
            return candela::Vec3Span{out[i].data(), out[i + 1].data(), out[i + 2].data()};
        };
        const candela::ConstVec3Span points{k_x.data(), k_y.data(), k_z.data()};
        light->illuminate(0, {.count = k_x.size(), .position = points, .normal = points},
                          {.to_light = span(0), .diffuse = span(3), .specular = span(6)});
        for (const float intensity : out[3])
            fuzz::require(std::isfinite(intensity) && intensity >= 0, "a lamp sends no usable number");
    } catch (const std::exception& problem) {
        fuzz::require(*problem.what() != '\0', "a refusal is empty");
    }
    return 0;
}
