// Objects that share a file.
#include <fmt/format.h>

#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <fstream>
#include <string>

#include "support/command.h"
#include "support/compiled.h"
#include "support/plugins.h"

using candela::Mesh;
using candela::Shape;

namespace {

/// The number of bytes that this process has read so far; none if Linux does not count them.
std::uint64_t bytes_read() {
    std::ifstream in("/proc/self/io");
    std::string key;
    std::uint64_t value = 0;
    while (in >> key >> value)
        if (key == "rchar:") return value;
    return 0;
}

/// A row of squares, each with its own material.
std::string squares(int materials, int each) {
    std::string text;
    for (int m = 0; m < materials; ++m) {
        text += fmt::format("usemtl m{}\n", m);
        for (int i = 0; i < each; ++i) {
            text += fmt::format("v {0} {1} 0\nv {0}.5 {1} 0\nv {0}.5 {1}.5 0\nv {0} {1}.5 0\n", i, m);
            text += "f -4 -3 -2 -1\n";
        }
    }
    return text;
}

Mesh placed(const Shape& shape) {
    return candela::build_mesh(shape, {}, {}, *instance<candela::ShadingModel>("phong"));
}

}  // namespace

TEST_CASE("shape/mesh: a scene with a hundred and twenty parts of a file reads it once") {
    const auto folder = scratch_directory();
    constexpr int k_materials = 120;
    const auto file = write_file(folder / "a.obj", squares(k_materials, 50));
    std::string scene =
        "version = 1\n[room]\nwidth = 400\nheight = 400\ndepth = 400\n[observer]\nposition = [0, 0, "
        "9]\nlook_at = [0, 0, 0]\n[shading]\nmodel = \"phong\"\n"
        "[reflection]\nmodel = \"phong\"\n[constraints]\noverlap = \"allow\"\n[[light]]\ntype = "
        "\"ambient\"\n";
    for (int m = 0; m < k_materials; ++m)
        scene += fmt::format(
            "[[object]]\ntype = \"mesh\"\nfile = {:?}\npart = \"m{}\"\nencloses = true\n"
            "[object.material]\nka = 0.1\nkd = 0.5\nks = 0.1\nshininess = 3\n",
            file.string(), m);
    candela::SceneRequest request;
    request.files = {write_file(folder / "scene.toml", scene)};
    const std::uint64_t before = bytes_read();
    const Compiled result = compiled(request);
    CHECK(bytes_read() - before < 2 * std::filesystem::file_size(file));
    REQUIRE(result.scene.objects.size() == k_materials);
    CHECK(result.scene.objects[17].mesh.triangle_count() == 100);
    CHECK(result.scene.objects[17].mesh.vertex_count() == 200);
}

TEST_CASE(
    "shape/mesh: a shape keeps its file for the next shape of that file, whatever its "
    "path") {
    const auto folder = scratch_directory();
    const auto file = write_file(folder / "a.obj", squares(20, 50));
    const auto shape_of = [&](const std::string& path) { return instance<Shape>("mesh", {{"file", path}}); };
    const auto first = shape_of(file.string());
    const Mesh mesh = placed(*first);
    const std::uint64_t before = bytes_read();
    const Mesh again = placed(*shape_of((folder / "." / "a.obj").string()));
    CHECK(bytes_read() - before < std::filesystem::file_size(file) / 2);
    CHECK(again.indices == mesh.indices);
    CHECK(again.position.x == mesh.position.x);
}

TEST_CASE("shape/mesh: shapes of one file see its changes") {
    const auto file = write_file(scratch_directory() / "a.obj", squares(2, 3));
    const auto of_part = [&](const char* part) {
        return instance<Shape>("mesh", {{"file", file.string()}, {"part", std::string(part)}});
    };
    const auto first = of_part("m0"), second = of_part("m1");
    CHECK(placed(*first).triangle_count() == 6);
    CHECK(placed(*second).triangle_count() == 6);
    write_file(file, squares(2, 5));
    CHECK(placed(*second).triangle_count() == 10);
    CHECK(placed(*first).triangle_count() == 10);
}
