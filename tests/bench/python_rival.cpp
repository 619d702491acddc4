// candela_python_rival evaluate N | render SCENE: does in C++ what tests/bench/python.py does in Python. For
// each line read, runs a round and prints its processor seconds.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

import candela.core;

namespace {

/// Calls `work` for each line of standard input, and prints the processor time that it took.
template <class Work>
void on_demand(const Work& work) {
    for (std::string line; std::getline(std::cin, line);) {
        const std::clock_t begin = std::clock();
        work();
        fmt::print("{}\n", static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
        std::fflush(stdout);
    }
}

struct Arrays {
    explicit Arrays(std::size_t count) : x(count), y(count), z(count) {}
    candela::Vec3Span span() { return {x.data(), y.data(), z.data()}; }

    std::vector<float> x, y, z;
};

std::array<std::vector<float>*, 3> channels(Arrays& arrays) { return {&arrays.x, &arrays.y, &arrays.z}; }

/// GGX at `count` points, in batches of the renderer's size, on one thread: the sum of its parts, into new
/// arrays.
void evaluate(std::size_t count) {
    candela::Registry registry(candela::plugin_search_path({}));
    candela::ParamSet values = registry.parameters(candela::PluginKind::reflection, "ggx");
    values.set("roughness", 0.2);
    const auto model = registry.create<candela::ReflectionModel>("ggx", values, candela::ColorEncoding::srgb);
    Arrays normals(count), to_observer(count), to_light(count);
    for (std::size_t i = 0; i < count; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(count);
        normals.span().set(i, {0, 1, 0});
        to_observer.span().set(i, candela::normalized({t, 1, 0.3f}));
        to_light.span().set(i, candela::normalized({-t, 1, 0.1f}));
    }
    constexpr std::size_t k_batch = 256;
    const std::vector<float> ones(k_batch, 1.0f);
    const candela::ConstVec3Span light{ones.data(), ones.data(), ones.data()};
    on_demand([&] {
        const auto result = std::make_unique_for_overwrite<float[]>(3 * count);  // as in NumPy
        Arrays ambient(k_batch), diffuse(k_batch), specular(k_batch);
        for (std::size_t first = 0; first < count; first += k_batch) {
            const std::size_t size = std::min(k_batch, count - first);
            for (Arrays* const part : {&diffuse, &specular}) {
                for (std::vector<float>* const channel : channels(*part)) std::ranges::fill(*channel, 0.0f);
            }
            model->reflect(
                {.count = size,
                 .normal = candela::ConstVec3Span(normals.span()).from(first),
                 .to_observer = candela::ConstVec3Span(to_observer.span()).from(first),
                 .tangent = {},
                 .color = {1, 1, 1}},
                {.to_light = candela::ConstVec3Span(to_light.span()).from(first),
                 .diffuse = light,
                 .specular = light},
                {.ambient = ambient.span(), .diffuse = diffuse.span(), .specular = specular.span()});
            for (std::size_t c = 0; c < 3; ++c) {
                float* const to = result.get() + c * count + first;
                const float* const a = channels(diffuse)[c]->data();
                const float* const b = channels(specular)[c]->data();
                for (std::size_t i = 0; i < size; ++i) to[i] = a[i] + b[i];
            }
        }
    });
}

int render(const std::string& file) {
    candela::Registry registry(candela::plugin_search_path({}));
    candela::Diagnostics diagnostics;
    candela::SceneRequest request;
    request.files = {file};
    const auto draft = candela::draft_scene(request, registry, diagnostics);
    const auto compiled = draft ? candela::build(*draft, registry, diagnostics) : std::nullopt;
    if (!compiled) return 1;
    on_demand([&] {
        const candela::ImageSettings& image = compiled->image;
        candela::Film film(image.width, image.height, candela::PixelType::byte, image.color_management);
        candela::render(*compiled, film, {});
    });
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    if (std::string(argv[1]) == "render") return render(argv[2]);
    evaluate(std::stoul(argv[2]));
    return 0;
}
