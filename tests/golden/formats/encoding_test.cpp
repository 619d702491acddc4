// Reads back the content of picture files with OpenImageIO.
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <catch2/catch_test_macros.hpp>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/samples.h"
#include "support/scene_tables.h"

namespace {

candela::Vec3 middle_of(const std::filesystem::path& file) {
    const auto input = OIIO::ImageInput::open(file.string());
    REQUIRE(input != nullptr);
    const OIIO::ImageSpec& spec = input->spec();
    REQUIRE(spec.nchannels == 3);
    std::vector<float> rgb(3 * static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height));
    REQUIRE(input->read_image(0, 0, 0, 3, OIIO::TypeFloat, rgb.data()));
    const std::size_t middle = 3 * static_cast<std::size_t>(spec.height / 2 * spec.width + spec.width / 2);
    return {rgb[middle], rgb[middle + 1], rgb[middle + 2]};
}

}  // namespace

TEST_CASE("scene colours are decoded from sRGB, and 8-bit pictures are encoded again") {
    const auto directory = scratch_directory();
    const auto pixel = [&](const char* management, const std::string& file) {
        const auto scene =
            write_file(directory / "scene.toml",
                       k_start + image_table(9, 9) +
                           fmt::format("background = [188, 64, 5]\ncolor_management = \"{}\"\n", management));
        succeeded(run_candela({"render", scene.string(), "-o", (directory / file).string()}));
        return middle_of(directory / file);
    };
    // 188, 64 and 5 of 255 decode to 0.5029, 0.05127 and 0.001518 (IEC 61966-2-1).
    CHECK(agree(pixel("srgb", "a.exr"), Double3{0.5029, 0.05127, 0.001518}, 1e-3));
    CHECK(agree(pixel("none", "b.exr"), Double3{188 / 255.0, 64 / 255.0, 5 / 255.0}, 1e-6));
    const Double3 as_written{188 / 255.0, 64 / 255.0, 5 / 255.0};
    CHECK(agree(pixel("srgb", "c.png"), as_written, 1e-6));
    CHECK(agree(pixel("none", "d.png"), as_written, 1e-6));
    CHECK(agree(pixel("srgb", "e.ppm"), as_written, 1e-6));
    CHECK(agree(pixel("srgb", "f.tif"), as_written, 1e-6));
}
