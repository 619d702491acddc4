// candela new: starter scenes.
#include <catch2/catch_test_macros.hpp>
#include <cstddef>
#include <filesystem>
#include <set>
#include <string>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/text.h"

namespace fs = std::filesystem;

TEST_CASE("new writes scene.toml, valid without a warning, and says what to do next") {
    const Folder directory;
    const CommandResult result = expect(directory.run("new"), 0, {"candela render scene.toml"});
    CHECK(result.out.empty());
    const CommandResult check =
        expect_out(directory.run("check scene.toml"), 0, {"lights    2", "objects   3"});
    CHECK(check.err.empty());
    const std::string text = directory.read("scene.toml");
    for (const char* const next : {"candela render", "candela check", "candela list", "candela describe"}) {
        CHECK(holds(text, next));
    }
}

TEST_CASE("the picture of the new scene shows lit objects of several colours") {
    const Folder directory;
    succeeded(directory.run("new mine.toml"));
    succeeded(directory.run("render mine.toml -o a.ppm"));
    constexpr std::size_t k_pixels = std::size_t{800} * 500;
    const std::string header = "P6\n800 500\n255\n";
    const std::string image = directory.read("a.ppm");
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
    const Folder directory;
    const fs::path file = directory.write("scene.toml", "mine");
    expect(directory.run("new"), 1, {"'scene.toml' already exists; --force replaces it"});
    CHECK(read_file(file) == "mine");
    expect(directory.run("new --force"), 0);
    CHECK(holds(read_file(file), "[observer]"));
    fs::create_symlink("nowhere.toml", directory / "link.toml");
    expect(directory.run("new link.toml"), 1);
}

TEST_CASE("new - prints the scene, and writes nothing") {
    const Folder directory;
    const CommandResult printed = directory.run("new -");
    CHECK(printed.exit_code == 0);
    CHECK(printed.err.empty());
    CHECK(fs::is_empty(directory));
    succeeded(directory.run("new"));
    CHECK(printed.out == directory.read("scene.toml"));
}

TEST_CASE("new in an impossible place, or with more than one name, is an error") {
    const Folder directory;
    expect(directory.run("new gone/scene.toml"), 1, {"there is no folder"});
    fs::create_directory(directory / "directory");
    expect(directory.run("new directory"), 1);
    expect(directory.run("new directory --force"), 1, {"is a directory"});
    expect(directory.run("new a.toml b.toml"), 2);
    CHECK(fs::is_empty(directory / "directory"));
}

TEST_CASE("the command suggested by new can be pasted into a shell") {
    const Folder directory;
    expect(directory.run_words({"new", "it's a scene.toml"}), 0, {"candela render 'it'\\''s a scene.toml'"});
}

TEST_CASE("plugin new starts from kernel files, whose description is kept, and from models of three kinds") {
    const Folder directory;
    const std::string light =
        "/// # Lamp\n/// A lamp, see lamp_at().\n///\n/// More about it.\n"
        "struct LampLight {\n    vec3 position;  /// point in m: where it is\n};\n"
        "const float lamp_power = 2.0f;\n"
        "KERNEL float lamp_at(float x) { return lamp_power * x; }\n"
        "KERNEL Incident lamp_illuminate(LampLight lamp, Receiver r) {\n"
        "    return point_source(lamp.position, vec3(1.0f), lamp_at(1.0f), 2, 0.0f, r);\n}\n";
    directory.write("lamp.kernel", light);
    expect(directory.run("plugin new light lamp --from lamp.kernel"), 0);
    CHECK(directory.read("lamp/lamp.kernel") == light);
    expect(directory.run("plugin new light oil-lamp --from lamp.kernel"), 0);
    CHECK(holds(directory.read("oil-lamp/oil-lamp.kernel"),
                "/// # Lamp\n/// A lamp, see oil_lamp_at().\n///\n/// More about it.\n"));
    CHECK(holds(directory.read("oil-lamp/oil-lamp.kernel"),
                "oil_lamp_illuminate(OilLampLight lamp, Receiver r)"));
    CHECK(holds(directory.read("oil-lamp/oil-lamp_test.cpp"),
                "{{\"position\", candela::Vec3{1.0f, 1.0f, 1.0f}}}"));

    // Prelude names that begin like the model's stay.
    expect(directory.run("plugin new light mine --from light/point"), 0);
    const std::string point = directory.read("mine/mine.kernel");
    CHECK(holds(point, "/// # Mine\n/// Based on Point light: one sentence about it.\n"));
    CHECK(holds(point, "KERNEL Incident mine_illuminate(MineLight"));
    CHECK(holds(point, "point_source("));
    expect(directory.run("plugin new shading smooth --from gouraud"), 0);
    CHECK(holds(directory.read("smooth/smooth.kernel"), "KERNEL vec3 smooth_normal("));
    expect(directory.run("plugin new shape ball --from sphere"), 2,
           {"expected the kind light, reflection or shading"});
    expect(directory.run("plugin new shading x --from lamp.kernel"), 2,
           {"is a light model; expected a shading model"});
    expect(directory.run("plugin new shading x --from light/point"), 2,
           {"'light/point' is not a shading model"});
}

TEST_CASE("plugin new accepts a kernel in the kernel language, and locates the error in another") {
    const Folder directory;
    const std::string kernel =
        "struct PhongMaterial { vec3 ka; vec3 kd; vec3 ks; float shininess; };\n"
        "KERNEL vec3 phong_reflect_ambient(PhongMaterial m, Surface s) { return m.ka * s.color; }\n"
        "KERNEL Reflected phong_reflect(PhongMaterial m, Surface s, vec3 to_light) {\n"
        "    STATEMENT\n    return Reflected(s.color, s.color);\n}\n";
    const auto made = [&](const std::string& statement) {
        std::string text = kernel;
        directory.write("mine.kernel", text.replace(text.find("STATEMENT"), 9, statement));
        return directory.run("plugin new reflection mine --from reflection/phong --kernel mine.kernel");
    };
    expect(made("Surface &t = s;"), 2,
           {"mine.kernel:4:13: the kernel language has neither pointers nor references"});
    CHECK(!directory.has("mine"));
    expect(made("float unused = 1.0f;  // so far"), 0);
    CHECK(holds(directory.read("mine/mine.kernel"), "float unused = 1.0f;  // so far"));
}
