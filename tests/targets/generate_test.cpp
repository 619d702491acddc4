// candela generate: its output and its errors.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <string>
#include <utility>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

const std::string k_still_life = CANDELA_TEST_SOURCE "/docs/examples/still-life.toml";

/// All shapes but meshes from files, coarse, under all kinds of light; one of them extends behind the
/// observer.
const std::string k_coarse = R"(version = 1
observer = {position = [0, 1, 4], look_at = [0, 0, 0]}
image = {width = 96, height = 64, samples = 4}
shading = {model = "phong"}
reflection = {model = "phong"}
room = {width = 40, height = 10, depth = 40}
light = [
    {type = "ambient"}, {type = "hemisphere"}, {type = "directional", direction = [1, -1, -1]},
    {type = "point", position = [2, 3, 2], intensity = 9},
    {type = "spot", position = [-2, 3, 2], direction = [1, -2, -1], intensity = 9},
    {type = "distributed", position = [0, 3, 0], intensity = 9},
]
object = [
    {type = "cube", scale = [30, 0.1, 30], position = [0, -1, 0]},
    {type = "sphere", segments = 9, position = [-1.5, 0, 0]},
    {type = "torus", segments = 9, rotation = [50, 0, 0], major_radius = 0.5, minor_radius = 0.2, position = [1.5, 0, 0]},
    {type = "teapot", segments = 3, position = [0, 0, -1]},
]
)";

void generate(const std::vector<std::string>& arguments) {
    succeeded(run_candela(joined({"generate"}, arguments)));
}

/// Compiles with every warning an error, and expects none.
void require_compiles(const std::vector<std::string>& compiler, const fs::path& source,
                      const fs::path& program) {
    const CommandResult result =
        run_program(joined(compiler, {"-std=c++17", "-O1", "-Wall", "-Wextra", "-Werror", source.string(),
                                      "-o", program.string()}));
    INFO(fmt::format("{}\n{}", compiler.front(), result.err.substr(0, 2000)));
    REQUIRE(result.exit_code == 0);
    CHECK(result.err.empty());
}

}  // namespace

TEST_CASE(
    "generate: the default scene's C++ program has fewer than 690 lines, and contains its kernels word for "
    "word") {
    const fs::path directory = scratch_directory();
    generate({"--target", "cpp", "-o", directory.string()});
    const std::string source = read_file(directory / "scene.cpp");
    CHECK(lines_of(source).size() < 690);
    CHECK(holds(source, read_file(CANDELA_TEST_SOURCE "/plugins/reflection/phong.kernel")));
    CHECK(holds(source, read_file(CANDELA_TEST_SOURCE "/plugins/light/point.kernel")));
    CHECK_FALSE(holds(source, "#include \""));
    CHECK(source.find('@') == std::string::npos);
}

TEST_CASE("generate: -o - prints the file that a target writes, byte for byte, and nothing else") {
    const fs::path directory = scratch_directory();
    generate({"--target", "webgl", "-o", directory.string()});
    const CommandResult page = run_candela({"generate", "--target", "webgl", "-o", "-"});
    CHECK(page.exit_code == 0);
    CHECK((page.out == read_file(directory / "scene.html")));
    CHECK(page.err.empty());

    const CommandResult program = expect(run_candela({"generate", "--target", "opengl", "-o", "-"}), 2,
                                         {"target/opengl writes", "give a folder"});
    CHECK(program.out.empty());
    expect(run_candela({"generate", "--target", "webgl", "-o", "-", "--run"}), 2, {"give a folder"});
}

TEST_CASE(
    "generate: the C++ programs compile with g++ and clang++ without a warning, and draw the same picture",
    "[programs]") {
    const fs::path directory = scratch_directory();
    for (const std::string& scene : {std::string(), k_still_life}) {
        std::vector<std::string> words{"--target", "cpp", "-o",       directory.string(),
                                       "--width",  "160", "--height", "100"};
        if (!scene.empty()) words.push_back(scene);
        generate(words);
        require_compiles({"g++"}, directory / "scene.cpp", directory / "by-gcc");
        require_compiles({CANDELA_TEST_COMPILER}, directory / "scene.cpp", directory / "by-clang");
        succeeded(run_program({(directory / "by-gcc").string(), (directory / "gcc.ppm").string()}));
        REQUIRE(
            run_program({(directory / "by-clang").string(), (directory / "clang.ppm").string()}).exit_code ==
            0);
        const std::string a = read_file(directory / "gcc.ppm"), b = read_file(directory / "clang.ppm");
        REQUIRE(a.size() == b.size());
        // One compiler may fuse a product and a sum where the other does not.
        std::size_t differing = 0;
        for (std::size_t i = 0; i < a.size(); ++i) differing += a[i] != b[i] ? 1 : 0;
        CHECK(differing < a.size() / 500);
    }
}

TEST_CASE("generate: the C++ program of a scene with many models runs clean under AddressSanitizer and UBSan",
          "[whole]") {
    const fs::path directory = scratch_directory();
    const fs::path scene = write_file(directory / "scene.toml", k_coarse);
    generate({scene.string(), "--target", "cpp", "-o", directory.string(), "--models", "all"});
    require_compiles(
        {CANDELA_TEST_COMPILER, "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"},
        directory / "scene.cpp", directory / "scene");
    for (const auto& models :
         {std::vector<std::string>{}, {"flat", "ward"}, {"gouraud", "ggx"}, {"derivative", "toon"}}) {
        expect(
            run_program(joined({(directory / "scene").string(), (directory / "scene.png").string()}, models)),
            0);
    }
}

TEST_CASE("generate: scenes without lights, without objects and without both become programs that compile",
          "[programs]") {
    const fs::path directory = scratch_directory();
    const std::string head =
        "version = 1\n[observer]\nposition = [0, 0, 3]\nlook_at = [0, 0, 0]\n[image]\nwidth = 32\nheight = "
        "24\n";
    const std::string light = "[[light]]\ntype = \"point\"\nposition = [0, 2, 2]\n";
    const std::string object =
        "[[object]]\ntype = \"sphere\"\nshading = \"phong\"\nreflection = \"lambert\"\n";
    int number = 0;
    for (const std::string& text : {head, head + light, head + object, head + light + object}) {
        const fs::path scene = write_file(directory / fmt::format("{}.toml", number++), text);
        generate({scene.string(), "--defaults", "--target", "cpp", "-o", directory.string()});
        require_compiles({"g++"}, directory / "scene.cpp", directory / "scene");
        expect(run_program({(directory / "scene").string(), (directory / "scene.png").string()}), 0);
        generate({scene.string(), "--defaults", "--target", "webgl", "-o", directory.string()});
    }
}

TEST_CASE("generate: --models adds models, and the C++ program switches to them") {
    const fs::path directory = scratch_directory();
    generate({"--target", "cpp", "-o", directory.string(), "--models", "half-lambert,shading/flat,ggx",
              "--width", "64", "--height", "64"});
    require_compiles({"g++"}, directory / "scene.cpp", directory / "scene");
    const auto image = [&](const std::vector<std::string>& models) {
        succeeded(run_program(
            joined({(directory / "scene").string(), (directory / "scene.ppm").string()}, models)));
        return read_file(directory / "scene.ppm");
    };
    const std::string own = image({});
    const bool same = image({"phong", "phong"}) == own;
    CHECK(same);
    const bool other_reflection = image({"phong", "half-lambert"}) != own;
    CHECK(other_reflection);
    const bool third_reflection = image({"phong", "ggx"}) != image({"phong", "half-lambert"});
    CHECK(third_reflection);
    const bool other_shading = image({"flat"}) != own;
    CHECK(other_shading);
}

TEST_CASE("generate: programs of scenes without shadows have no trace of them") {
    const fs::path directory = scratch_directory();
    const fs::path scene = write_file(directory / "scene.toml", "shadows = {enabled = true}\n" + k_coarse);
    const auto has_traces = [&](const std::vector<std::string>& more) {
        for (const char* const target : {"opengl", "webgl"})
            generate(joined({scene.string(), "--target", target, "-o", (directory / target).string()}, more));
        std::vector<bool> found;
        for (const auto& [file, trace] : std::vector<std::pair<std::string, std::string>>{
                 {"opengl/scene.cpp", "shadow_tree"},
                 {"opengl/meshes.h", "ShadowTree"},
                 {"opengl/README.md", "shadows off"},
                 // Its script is always the same.
                 {"webgl/scene.html", "uniform highp isampler2D shadow_tree"},
                 {"webgl/scene.html", "\"shadows\":"}})
            found.push_back(holds(read_file(directory / file), trace));
        return found;
    };
    CHECK(has_traces({}) == std::vector<bool>(5, true));
    CHECK(has_traces({"--no-shadows"}) == std::vector<bool>(5, false));
}

TEST_CASE("generate: an OpenGL program draws with shadows and without", "[programs]") {
    const fs::path directory = scratch_directory();
    const fs::path scene = write_file(directory / "scene.toml", "shadows = {enabled = true}\n" + k_coarse);
    const auto made = [&](const std::string& name, const std::vector<std::string>& more) {
        const std::string program = (directory / name).string();
        generate(joined({scene.string(), "--target", "opengl", "-o", program, "--build", "--quiet"}, more));
        return program + "/build/scene";
    };
    const auto drawn = [&](const std::string& program, const std::string& name,
                           const std::vector<std::string>& options) {
        const std::string picture = (directory / name).string();
        succeeded(run_program(joined({program, "--headless", "--output", picture}, options)));
        return picture;
    };
    const std::string with = made("with", {});
    const std::string on = drawn(with, "on.png", {}), off = drawn(with, "off.png", {"--no-shadows"});
    const std::string without = drawn(made("without", {"--no-shadows"}), "without.png", {});
    succeeded(run_candela({"diff", off, without, "--tolerance", "1"}));
    CHECK(run_candela({"diff", on, without, "--tolerance", "1"}).exit_code == 4);
}

TEST_CASE("generate: programs have help, and refuse unknown arguments") {
    const fs::path directory = scratch_directory();
    generate({"--target", "cpp", "-o", directory.string(), "--models", "half-lambert,shading/flat", "--width",
              "32", "--height", "32"});
    require_compiles({"g++"}, directory / "scene.cpp", directory / "scene");
    generate({"--target", "cpp", "-o", (directory / "one").string(), "--width", "32", "--height", "32"});
    require_compiles({"g++"}, directory / "one/scene.cpp", directory / "one/scene");
    const auto run = [&](const std::string& program, std::vector<std::string> words) {
        words.insert(words.begin(), (directory / program).string());
        CommandSetup setup{.directory = directory};
        return run_program(words, setup);
    };
    const CommandResult help = expect_out(
        run("scene", {"--help"}), 0,
        {"scene [PICTURE [SHADING [REFLECTION]]]", "REFLECTION: of all objects: phong, half-lambert"});
    CHECK(holds(run("one/scene", {"--help"}).out, "scene [PICTURE]\n"));
    CHECK_FALSE(fs::exists(directory / "--help"));
    struct Mistake {
        std::string program;
        std::vector<std::string> words;
        std::string complaint;
    };
    const std::vector<Mistake> mistakes = {{"scene", {"--heigth"}, "'--heigth'"},
                                           {"scene", {"a.ppm", "falt"}, "'falt'"},
                                           {"scene", {"a.ppm", "flat", "half"}, "half-lambert"},
                                           {"scene", {"a.ppm", "flat", "phong", "more"}, "'more'"},
                                           {"one/scene", {"a.ppm", "flat"}, "'flat'"}};
    for (const auto& [program, words, complaint] : mistakes) {
        expect(run(program, words), 1, {complaint});
        CHECK_FALSE(fs::exists(directory / "a.ppm"));
    }
    CHECK(run("scene", {"a.ppm", "flat", "half-lambert"}).exit_code == 0);
}

TEST_CASE("generate: programs name the CA and RE that their comments cite") {
    const fs::path directory = scratch_directory();
    for (const std::string& target : {std::string("cpp"), std::string("opengl")}) {
        generate({"--target", target, "-o", (directory / target).string()});
        for (const std::string& file : {std::string("scene.cpp"), std::string("README.md")}) {
            const std::string text = read_file(directory / target / file);
            CHECK(holds(text, "Commonality Analysis for Family of Lighting Models"));
            CHECK(holds(text, "Rendering equation"));
        }
    }
}

TEST_CASE("generate: a newer compiler's warnings do not fail the build of a program") {
    for (const char* const target : {"cpp", "opengl"}) {
        const fs::path directory = scratch_directory() / target;
        generate({"--target", target, "-o", directory.string()});
        const std::string cmake = read_file(directory / "CMakeLists.txt");
        CHECK(holds(cmake, "-Wall -Wextra"));
        CHECK_FALSE(holds(cmake, "-Werror"));
    }
}

TEST_CASE("generate: errors name the problem and the remedy") {
    const fs::path directory = scratch_directory();
    const auto expect_error = [&](const std::vector<std::string>& arguments, int code,
                                  const std::string& message) {
        expect(run_candela(joined({"generate"}, arguments)), code, {message});
    };
    const std::string out = (directory / "program").string();
    expect_error({}, 2, "--target is missing");
    expect_error({"--target", "opengI"}, 2, "did you mean 'opengl'?");
    expect_error({"--target", "cpp", "-o", out, "--models", "lambrt"}, 2, "did you mean 'lambert'?");
    expect_error({"--target", "cpp", "-o", out, "--reflection", "dielectric"}, 1, "reflection/dielectric");
    expect_error({"--target", "cpp", "-o", out, CANDELA_TEST_SOURCE "/docs/examples/glass.toml"}, 1,
                 "environment");
    expect_error({"--target", "cpp", "-o", out, "missing.toml"}, 1, "missing.toml");
    expect_error({"--target", "cpp", "-o", out, "--set", "light.lamp.intensity=-1"}, 3, "intensity");
    CHECK_FALSE(fs::exists(out));
    write_file(directory / "file", "");
    expect_error({"--target", "cpp", "-o", (directory / "file").string()}, 1, "cannot be created");
#ifdef CANDELA_TEST_FAULTY_PLUGINS
    for (const char* const target : {"webgl", "three"})
        expect_error({"--target", target, "-o", out, "--plugin-dir", CANDELA_TEST_FAULTY_PLUGINS,
                      "--reflection", "faultless"},
                     1, "reflection/faultless has no kernel");
#endif
}

namespace {

/// The number of lines that are neither blank nor comments.
int written_lines(const std::string& text) {
    int count = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string line = text.substr(begin, end - begin);
        const std::size_t first = line.find_first_not_of(' ');
        if (first != std::string::npos && line.compare(first, 2, "//") != 0) ++count;
        begin = end + 1;
    }
    return count;
}

}  // namespace

TEST_CASE("generate: docs/user/exporting.md states the line counts of the default scene's programs") {
    const fs::path directory = scratch_directory();
    generate({"--target", "cpp", "-o", (directory / "cpp").string()});
    generate({"--target", "opengl", "-o", (directory / "opengl").string()});
    const int cpp = written_lines(read_file(directory / "cpp/scene.cpp"));
    const int opengl = written_lines(read_file(directory / "opengl/scene.cpp")) +
                       written_lines(read_file(directory / "opengl/meshes.h"));
    const fs::path cube = CANDELA_TEST_SOURCE "/docs/examples/cube.toml";
    const std::string page = read_file(CANDELA_TEST_SOURCE "/docs/user/exporting.md");
    INFO(fmt::format("C++ {}, OpenGL {}, scene {}", cpp, opengl, written_lines(read_file(cube))));
    CHECK(holds(page, fmt::format("| C++ alone | {} |", cpp)));
    CHECK(holds(page, fmt::format("| OpenGL 3.3 | {} |", opengl)));
    CHECK(holds(page, fmt::format("| Candela, as a scene file | {} |", written_lines(read_file(cube)))));

    succeeded(run_candela({"render", cube.string(), "-o", (directory / "cube.ppm").string()}));
    succeeded(run_candela({"render", "-o", (directory / "default.ppm").string()}));
    CHECK(read_file(directory / "cube.ppm") == read_file(directory / "default.ppm"));
}
