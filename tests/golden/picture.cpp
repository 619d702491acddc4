#include "golden/picture.h"

#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <string>

#include "support/command.h"

namespace {

/// Reads a PFM file (Debevec): "PF", width and height, "-1.0", then little-endian floats, rows from the
/// bottom.
Picture read_pfm(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string kind;
    Picture picture;
    double scale = 0;
    in >> kind >> picture.width >> picture.height >> scale;
    in.get();
    REQUIRE(kind == "PF");
    REQUIRE(scale == -1);
    const auto row = 3 * static_cast<std::size_t>(picture.width);
    picture.rgb.resize(row * static_cast<std::size_t>(picture.height));
    for (auto y = static_cast<std::size_t>(picture.height); y-- > 0;)
        in.read(reinterpret_cast<char*>(&picture.rgb[y * row]), static_cast<std::streamsize>(4 * row));
    REQUIRE(in.good());
    REQUIRE(in.peek() == std::ifstream::traits_type::eof());
    return picture;
}

}  // namespace

Picture render_floats(const std::filesystem::path& directory, const std::string& scene,
                      const std::vector<std::string>& arguments) {
    const auto file = write_file(directory / "scene.toml", "version = 1\n" + scene);
    const auto pfm = directory / "picture.pfm";
    std::vector<std::string> words = {"render", file.string(), "-o", pfm.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const CommandResult result = run_candela(words);
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    return read_pfm(pfm);
}

Double3 orthographic_point(const Picture& picture, int x, int y, double metres) {
    const double scale = metres / picture.height;
    return {(x + 0.5 - 0.5 * picture.width) * scale, (0.5 * picture.height - y - 0.5) * scale, 0};
}

Double3 perspective_ray(const Picture& picture, int x, int y, double fov_degrees) {
    const double focal = 0.5 * picture.height / std::tan(0.5 * fov_degrees * 3.14159265358979323846 / 180);
    return unit({x + 0.5 - 0.5 * picture.width, 0.5 * picture.height - y - 0.5, -focal});
}
