// candela::inspect_pixel(): an explained pixel is the picture's.
#include <png.h>

#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/compiled.h"
#include "support/expect.h"

namespace {

struct Png {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;
};

/// Reads a PNG with libpng.
Png read_png(const std::filesystem::path& file) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_file(&image, file.c_str()) != 0);
    image.format = PNG_FORMAT_RGB;
    Png png{static_cast<int>(image.width), static_cast<int>(image.height), {}};
    png.rgb.resize(PNG_IMAGE_SIZE(image));
    REQUIRE(png_image_finish_read(&image, nullptr, png.rgb.data(), 0, nullptr) != 0);
    return png;
}

std::vector<candela::Vec3> parts_of(const candela::PointTrace& point) {
    candela::Vec3 ambient, diffuse, specular = point.surroundings;
    for (const candela::LightTrace& light : point.lights) {
        ambient = ambient + light.reflected_ambient;
        diffuse = diffuse + light.reflected_diffuse;
        specular = specular + light.reflected_specular;
    }
    return {ambient, diffuse, specular};
}

bool are_close(candela::Vec3 a, candela::Vec3 b, float scale) {
    return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)}) <= 1e-5f * scale;
}

/// The largest magnitude of any light's share, to which rounding errors are relative.
float scale_of(const candela::PointTrace& point) {
    float scale = 1e-3f;
    for (const candela::LightTrace& light : point.lights) {
        for (const candela::Vec3 v :
             {light.reflected_ambient, light.reflected_diffuse, light.reflected_specular})
            scale = std::max({scale, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    }
    return scale * static_cast<float>(point.lights.size() + 1);
}

}  // namespace

/// Three objects that fill most of a small picture, and a light of each type.
std::string scene_with(const std::string& reflection, const std::array<std::string, 3>& shadings,
                       int samples) {
    return "version = 1\n[observer]\nposition = [0.3, 1.6, 4.2]\nlook_at = [0, 0, 0]\nfov = 30\n"
           "[image]\nwidth = 96\nheight = 64\nbackground = [20, 30, 40]\nsamples = " +
           std::to_string(samples) +
           "\n[[light]]\ntype = \"point\"\nposition = [-2, 3, 3]\nintensity = 6\n"
           "[[light]]\ntype = \"ambient\"\ncolor = [60, 60, 80]\n"
           "[[light]]\ntype = \"spot\"\nposition = [2, 3, 3]\ndirection = [-0.6, -1, -1]\nintensity = 8\n"
           "[[light]]\ntype = \"directional\"\ndirection = [0.3, -1, -0.5]\nintensity = 0.2\n"
           "[[light]]\ntype = \"hemisphere\"\nintensity = 0.1\n"
           "[[light]]\ntype = \"environment\"\nintensity = 0.1\nsamples = 4\n"
           "[[light]]\ntype = \"sky\"\nintensity = 0.1\n"
           "[[light]]\ntype = \"gradient\"\nintensity = 0.1\n"
           "[[light]]\ntype = \"studio\"\nintensity = 0.1\n"
           "[[light]]\ntype = \"ies\"\nposition = [1, 2, 2]\ndirection = [0, -1, 0]\nintensity = 2\n"
           "[[light]]\ntype = \"distributed\"\nposition = [0, 4, 2]\nintensity = 3\n"
           "[[object]]\ntype = \"sphere\"\nposition = [-1.1, 0, 0]\nshading = \"" +
           shadings[0] +
           "\"\n[[object]]\ntype = \"torus\"\nposition = [0.9, -0.2, 0.6]\nrotation = [30, 0, 0]\nshading = "
           "\"" +
           shadings[1] +
           "\"\n[[object]]\ntype = \"cube\"\nposition = [0.2, 0.1, -1.2]\nrotation = [0, 30, 0]\nshading = "
           "\"" +
           shadings[2] + "\"\n[reflection]\nmodel = \"" + reflection + "\"\n";
}

TEST_CASE(
    "the byte of a probed pixel is the PNG's, for random pixels of scenes that use every shipped model") {
    std::mt19937 random(17);
    std::set<std::string> reflections, shadings, lights;
    int pixels = 0, lit = 0;
    candela::Registry registry({CANDELA_TEST_PLUGINS}, candela::PluginTrust::any);
    const std::vector<std::string> all_shadings = registry.names(candela::PluginKind::shading);
    const auto shading = [&](std::size_t i) { return all_shadings[i % all_shadings.size()]; };
    std::size_t scenes = 0;
    for (const std::string& reflection : registry.names(candela::PluginKind::reflection)) {
        INFO(reflection);
        const std::size_t first = 3 * scenes++;
        const std::string text = scene_with(
            reflection, {shading(first), shading(first + 1), shading(first + 2)}, scenes % 2 == 0 ? 4 : 1);
        const auto folder = scratch_directory();
        const auto file = write_file(folder / "scene.toml", text);
        const auto picture = folder / "picture.png";
        succeeded(run_candela(
            {"render", file.string(), "-o", picture.string(), "--width", "96", "--height", "64", "--quiet"}));
        const Png png = read_png(picture);
        const Compiled scene = compiled(text);
        for (const candela::LightSource& light : scene.source.lights) lights.insert(light.model.name);
        for (int i = 0; i < 60; ++i, ++pixels) {
            const int x = static_cast<int>(random() % 96), y = static_cast<int>(random() % 64);
            INFO("pixel " << x << "," << y);
            const candela::InspectedPixel probe = candela::inspect_pixel(scene.scene, x, y);
            const auto at = 3 * static_cast<std::size_t>(y * png.width + x);
            CHECK(
                std::equal(probe.bytes.begin(), probe.bytes.end(), png.rgb.begin() + static_cast<long>(at)));
            candela::Vec3 sum = probe.background_weight * probe.background;
            float scale = 1;
            for (const candela::InspectedFragment& fragment : probe.fragments) {
                ++lit;
                const candela::Object& object = scene.source.objects[fragment.object];
                reflections.insert(object.reflection.name);
                shadings.insert(object.shading.name);
                sum = sum + fragment.weight * fragment.intensity;
                scale = std::max({scale, std::abs(fragment.intensity.x), std::abs(fragment.intensity.y),
                                  std::abs(fragment.intensity.z)});
                for (const candela::PointTrace& point : fragment.points) {
                    const auto parts = parts_of(point);
                    CHECK(are_close(parts[0], point.ambient, scale_of(point)));
                    CHECK(are_close(parts[1], point.diffuse, scale_of(point)));
                    CHECK(are_close(parts[2], point.specular, scale_of(point)));
                    CHECK(are_close(point.ambient + point.diffuse + point.specular, point.intensity,
                                    scale_of(point)));
                }
            }
            CHECK(are_close(sum, probe.intensity, 16 * scale));
        }
    }
    CHECK(pixels >= 500);
    CHECK(lit >= 500);
    INFO("reflections " << reflections.size() << ", shadings " << shadings.size() << ", lights "
                        << lights.size());
    for (const std::string& name : registry.names(candela::PluginKind::reflection)) {
        INFO(name);
        CHECK(reflections.contains(name));
    }
    for (const std::string& name : registry.names(candela::PluginKind::shading)) {
        INFO(name);
        CHECK(shadings.contains(name));
    }
    for (const std::string& name : registry.names(candela::PluginKind::light)) {
        INFO(name);
        CHECK(lights.contains(name));
    }
}

TEST_CASE("a pixel outside the picture cannot be probed") {
    const Compiled scene = compiled(std::string(candela::default_scene_text()));
    CHECK_THROWS_AS(candela::inspect_pixel(scene.scene, -1, 0), std::out_of_range);
    CHECK_THROWS_AS(candela::inspect_pixel(scene.scene, 0, scene.scene.image.height), std::out_of_range);
}
