// candela_kernel_loops THEIRS OURS MODEL...: times the loop of a reflection model in the plugins of two
// folders, in turns, with each instruction set of this processor.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <exception>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

import candela.core;

namespace {

constexpr std::size_t k_points = 256;  // the renderer's batch size
constexpr int k_rounds = 2000;
constexpr int k_calls = 20;

struct Vectors {
    std::array<float, k_points> x{}, y{}, z{};

    candela::Vec3Span span() { return {x.data(), y.data(), z.data()}; }
};

/// Unit vectors that point roughly upwards.
Vectors directions(std::minstd_rand& random) {
    std::uniform_real_distribution<float> aside(-1, 1), up(0.1f, 1);
    Vectors result;
    for (std::size_t i = 0; i < k_points; ++i)
        result.span().set(i, candela::normalized({aside(random), up(random), aside(random)}));
    return result;
}

std::unique_ptr<candela::ReflectionModel> model(const char* directory, const char* name) {
    candela::Registry registry({directory});
    return registry.create<candela::ReflectionModel>(
        name, registry.parameters(candela::PluginKind::reflection, name), candela::ColorEncoding::none);
}

void compare(const char* theirs, const char* ours, const char* name) {
    std::minstd_rand random(1);
    Vectors normal = directions(random), to_observer = directions(random), to_light = directions(random);
    Vectors intensity = directions(random), out[3];
    const candela::SurfaceBatch surface{.count = k_points,
                                        .normal = normal.span(),
                                        .to_observer = to_observer.span(),
                                        .tangent = {},
                                        .color = {0.5f, 0.5f, 0.5f}};
    const candela::LightingBatch light{
        .to_light = to_light.span(), .diffuse = intensity.span(), .specular = intensity.span()};
    const candela::ReflectedBatch reflected{
        .ambient = out[0].span(), .diffuse = out[1].span(), .specular = out[2].span()};

    const std::array models = {model(theirs, name), model(ours, name)};
    std::array<double, 2> least;
    least.fill(std::numeric_limits<double>::infinity());
    for (int round = 0; round < k_rounds; ++round) {
        for (std::size_t which = 0; which < models.size(); ++which) {
            const auto begin = std::chrono::steady_clock::now();
            for (int call = 0; call < k_calls; ++call) models[which]->reflect(surface, light, reflected);
            const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - begin;
            least[which] = std::min(least[which], time.count() / (k_calls * k_points));
        }
    }
    fmt::print("{:<16} {:<9} {:6.2f} ns  {:6.2f} ns  {:5.2f}\n", name,
               candela::name_of(candela::instruction_set()), least[0], least[1], least[0] / least[1]);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 4) {
        fmt::print(stderr, "usage: candela_kernel_loops THEIRS OURS MODEL...\n");
        return 2;
    }
    try {
        fmt::print("{:<26} {:>6}     {:>6}     ratio; nanoseconds a point, the least of {}\n", "", "theirs",
                   "ours", k_rounds);
        for (const candela::InstructionSet set : candela::k_instruction_sets) {
            if (!candela::use_instruction_set(set)) continue;
            for (int i = 3; i < argc; ++i) compare(argv[1], argv[2], argv[i]);
        }
        return 0;
    } catch (const std::exception& problem) {
        fmt::print(stderr, "candela_kernel_loops: {}\n", problem.what());
        return 1;
    }
}
