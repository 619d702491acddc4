#include "golden/image.h"

#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <string>

#include "support/command.h"
#include "support/expect.h"

namespace {

/// Reads a PFM file (Debevec): "PF", width and height, "-1.0", then little-endian floats, rows from the
/// bottom.
Image read_pfm(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string kind;
    Image image;
    double scale = 0;
    in >> kind >> image.width >> image.height >> scale;
    in.get();
    REQUIRE(kind == "PF");
    REQUIRE(scale == -1);
    const auto row = 3 * static_cast<std::size_t>(image.width);
    image.rgb.resize(row * static_cast<std::size_t>(image.height));
    for (auto y = static_cast<std::size_t>(image.height); y-- > 0;)
        in.read(reinterpret_cast<char*>(&image.rgb[y * row]), static_cast<std::streamsize>(4 * row));
    REQUIRE(in.good());
    REQUIRE(in.peek() == std::ifstream::traits_type::eof());
    return image;
}

}  // namespace

Image render_floats(const std::filesystem::path& directory, const std::string& scene,
                    const std::vector<std::string>& arguments) {
    const auto file = write_file(directory / "scene.toml", "version = 1\n" + scene);
    const auto pfm = directory / "picture.pfm";
    succeeded(run_candela(joined({"render", file.string(), "-o", pfm.string()}, arguments)));
    return read_pfm(pfm);
}

Double3 orthographic_point(const Image& image, int x, int y, double metres) {
    const double scale = metres / image.height;
    return {(x + 0.5 - 0.5 * image.width) * scale, (0.5 * image.height - y - 0.5) * scale, 0};
}

Double3 perspective_ray(const Image& image, int x, int y, double fov_degrees) {
    const double focal = 0.5 * image.height / std::tan(0.5 * fov_degrees * 3.14159265358979323846 / 180);
    return unit({x + 0.5 - 0.5 * image.width, 0.5 * image.height - y - 0.5, -focal});
}
