#include "golden/picture.h"

#include <OpenImageIO/imageio.h>

#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <memory>

#include "support/command.h"

Picture read_picture(const std::filesystem::path& file) {
    const auto input = OIIO::ImageInput::open(file.string());
    REQUIRE(input != nullptr);
    const OIIO::ImageSpec& spec = input->spec();
    REQUIRE(spec.nchannels == 3);
    Picture picture{spec.width, spec.height, {}};
    picture.rgb.resize(3 * static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height));
    REQUIRE(input->read_image(0, 0, 0, 3, OIIO::TypeFloat, picture.rgb.data()));
    return picture;
}

Picture render_exr(const std::filesystem::path& directory, const std::string& scene,
                   const std::vector<std::string>& arguments) {
    const auto file = write_file(directory / "scene.toml", "version = 1\n" + scene);
    const auto exr = directory / "picture.exr";
    std::vector<std::string> words = {"render", file.string(), "-o", exr.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const CommandResult result = run_candela(words);
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    return read_picture(exr);
}

Double3 orthographic_point(const Picture& picture, int x, int y, double metres) {
    const double scale = metres / picture.height;
    return {(x + 0.5 - 0.5 * picture.width) * scale, (0.5 * picture.height - y - 0.5) * scale, 0};
}

Double3 perspective_ray(const Picture& picture, int x, int y, double fov_degrees) {
    const double focal = 0.5 * picture.height / std::tan(0.5 * fov_degrees * 3.14159265358979323846 / 180);
    return unit({x + 0.5 - 0.5 * picture.width, 0.5 * picture.height - y - 0.5, -focal});
}
