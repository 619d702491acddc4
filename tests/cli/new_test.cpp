// candela new: starter scenes.
#include <catch2/catch_test_macros.hpp>
#include <cstddef>
#include <filesystem>
#include <set>
#include <string>

#include "support/command.h"
#include "support/expect.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

CommandSetup in(const fs::path& directory) {
    return {.input = "", .environment = {}, .directory = directory};
}

}  // namespace

TEST_CASE("new writes scene.toml, valid without a warning, and says what to do next") {
    const fs::path directory = scratch_directory();
    const CommandResult result = run_candela({"new"}, in(directory));
    CHECK(result.exit_code == 0);
    CHECK(result.out.empty());
    CHECK(holds(result.err, "candela render scene.toml"));
    const CommandResult check = run_candela({"check", "scene.toml"}, in(directory));
    CHECK(check.exit_code == 0);
    CHECK(check.err.empty());
    CHECK(holds(check.out, "lights    2"));
    CHECK(holds(check.out, "objects   3"));
    const std::string text = read_file(directory / "scene.toml");
    for (const char* const next : {"candela render", "candela check", "candela list", "candela describe"}) {
        CHECK(holds(text, next));
    }
}

TEST_CASE("the picture of the new scene shows lit objects of several colours") {
    const fs::path directory = scratch_directory();
    succeeded(run_candela({"new", "mine.toml"}, in(directory)));
    succeeded(run_candela({"render", "mine.toml", "-o", "a.ppm"}, in(directory)));
    constexpr std::size_t k_pixels = std::size_t{800} * 500;
    const std::string header = "P6\n800 500\n255\n";
    const std::string image = read_file(directory / "a.ppm");
    REQUIRE(image.starts_with(header));
    REQUIRE(image.size() == header.size() + 3 * k_pixels);
    std::set<std::string> colors;
    std::size_t background = 0, red = 0, bright = 0;
    for (std::size_t i = header.size(); i < image.size(); i += 3) {
        const std::string pixel = image.substr(i, 3);
        const auto r = static_cast<unsigned char>(pixel[0]), g = static_cast<unsigned char>(pixel[1]),
                   b = static_cast<unsigned char>(pixel[2]);
        colors.insert(pixel);
        background += r == 24 && g == 26 && b == 34 ? 1 : 0;
        red += r > 2 * g && r > 2 * b && r > 100 ? 1 : 0;
        bright += r > 200 && g > 150 ? 1 : 0;
    }
    CHECK(colors.size() > 1000);
    CHECK(background > k_pixels / 10);
    CHECK(background < k_pixels * 9 / 10);
    CHECK(red > k_pixels / 100);  // the ball
    CHECK(bright > 0);            // highlights
}

TEST_CASE("new keeps an existing file, unless --force is given") {
    const fs::path directory = scratch_directory();
    const fs::path file = write_file(directory / "scene.toml", "mine");
    expect(run_candela({"new"}, in(directory)), 1, {"'scene.toml' already exists; --force replaces it"});
    CHECK(read_file(file) == "mine");
    expect(run_candela({"new", "--force"}, in(directory)), 0);
    CHECK(holds(read_file(file), "[observer]"));
    fs::create_symlink("nowhere.toml", directory / "link.toml");
    expect(run_candela({"new", "link.toml"}, in(directory)), 1);
}

TEST_CASE("new - prints the scene, and writes nothing") {
    const fs::path directory = scratch_directory();
    const CommandResult printed = run_candela({"new", "-"}, in(directory));
    CHECK(printed.exit_code == 0);
    CHECK(printed.err.empty());
    CHECK(fs::is_empty(directory));
    succeeded(run_candela({"new"}, in(directory)));
    CHECK(printed.out == read_file(directory / "scene.toml"));
}

TEST_CASE("new in an impossible place, or with more than one name, is an error") {
    const fs::path directory = scratch_directory();
    expect(run_candela({"new", "gone/scene.toml"}, in(directory)), 1, {"there is no folder"});
    fs::create_directory(directory / "directory");
    expect(run_candela({"new", "directory"}, in(directory)), 1);
    expect(run_candela({"new", "directory", "--force"}, in(directory)), 1, {"is a directory"});
    expect(run_candela({"new", "a.toml", "b.toml"}, in(directory)), 2);
    CHECK(fs::is_empty(directory / "directory"));
}

TEST_CASE("the command suggested by new can be pasted into a shell") {
    const fs::path directory = scratch_directory();
    expect(run_candela({"new", "it's a scene.toml"}, in(directory)), 0,
           {"candela render 'it'\\''s a scene.toml'"});
}

TEST_CASE("plugin new accepts a kernel in the kernel language, and locates the error in another") {
    const fs::path directory = scratch_directory();
    const std::string kernel =
        "struct PhongMaterial { vec3 ka; vec3 kd; vec3 ks; float shininess; };\n"
        "KERNEL vec3 phong_reflect_ambient(PhongMaterial m, Surface s) { return m.ka * s.color; }\n"
        "KERNEL Reflected phong_reflect(PhongMaterial m, Surface s, vec3 to_light) {\n"
        "    STATEMENT\n    return Reflected(s.color, s.color);\n}\n";
    const auto made = [&](const std::string& statement) {
        std::string text = kernel;
        write_file(directory / "mine.kernel", text.replace(text.find("STATEMENT"), 9, statement));
        return run_candela(
            {"plugin", "new", "reflection", "mine", "--from", "reflection/phong", "--kernel", "mine.kernel"},
            in(directory));
    };
    expect(made("Surface &t = s;"), 2,
           {"mine.kernel:4:13: the kernel language has neither pointers nor references"});
    CHECK(!fs::exists(directory / "mine"));
    expect(made("float unused = 1.0f;  // so far"), 0);
    CHECK(holds(read_file(directory / "mine/mine.kernel"), "float unused = 1.0f;  // so far"));
}
