// candela verify catches faults of a program, however small.
#include <fmt/format.h>

#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

constexpr const char* k_scene = R"(version = 1
observer = {position = [0, 0.6, 4], look_at = [0, 0, 0], fov = 40}
image = {width = 240, height = 180}
shading = {model = "phong"}
reflection = {model = "phong"}
light = [
    {name = "sky", type = "ambient", intensity = 0.4},
    {name = "lamp", type = "point", position = [1.5, 2, 2.5], intensity = 7},
    {name = "fill", type = "point", position = [-2.5, 0.5, 2], intensity = 2},
]
object = [
    {name = "ball", type = "sphere", radius = 0.9, segments = 48, position = [-0.9, 0, 0], color = [230, 120, 60]},
    {name = "ring", type = "torus", major_radius = 0.6, minor_radius = 0.28, segments = 40, position = [1, 0, 0], rotation = [60, 20, 0], color = [90, 160, 220]},
]
)";

struct Edit {
    std::string_view from, to;
};

/// One fault, in each of the three programs. All occurrences of the text are changed.
struct Mutation {
    const char* name;
    Edit cpp, opengl, webgl;
};

// The kernels and most of the shaders are shared text.
constexpr Edit k_swapped = {"vec4(encoded(i.r), encoded(i.g)", "vec4(encoded(i.g), encoded(i.r)"};
constexpr Edit k_below = {"ivec2(gl_FragCoord.xy), 0).rgb", "ivec2(gl_FragCoord.xy) + ivec2(0, 1), 0).rgb"};
constexpr Edit k_linear = {"return !is_srgb ? c :", "return true ? c :"};
constexpr Edit k_attenuated = {"law == 0 ? r * r", "law == 0 ? r"};
constexpr Edit k_flipped = {"normalize(p.vertex_normal)", "-normalize(p.vertex_normal)"};
constexpr Edit k_no_ambient = {"return m.ka * s.color", "return 0.0f * s.color"};
constexpr Edit k_metallic = {"m.ks * (n_dot_l", "m.ks * s.color * (n_dot_l"};
constexpr Edit k_clamped = {"> 0.0f ? highlight", "> 0.0f ? -max(-highlight, -0.9f)"};
// A program that does as little as `int main() {}`.
constexpr Edit k_gone = {"int main(int argc, char** argv) {",
                         "int main(int argc, char** argv) {\n    if (argc > 0) return 0;"};

constexpr std::array k_mutations = {
    Mutation{.name = "the picture is displaced by a sixteenth of a pixel",
             .cpp = {"{vec2(0.5f, 0.5f)}", "{vec2(0.5625f, 0.5f)}"},
             .opengl = {"{{{0.5f, 0.5f}}}", "{{{0.5625f, 0.5f}}}"},
             .webgl = {"\"sample_positions\":[[0.5,0.5]]", "\"sample_positions\":[[0.5625,0.5]]"}},
    Mutation{.name = "a light has 1.002 times its intensity",
             .cpp = {"vec3(1.0f), 7.0f", "vec3(1.0f), 7.014f"},
             .opengl = {"{7.0f, 0, 0}", "{7.014f, 0, 0}"},
             .webgl = {"\"intensity\":7.0", "\"intensity\":7.014"}},
    Mutation{.name = "Phong's exponent is larger by 1",
             .cpp = {"vec3(0.3f), 32.0f}", "vec3(0.3f), 33.0f}"},
             .opengl = {"{32.0f, 0, 0}", "{33.0f, 0, 0}"},
             .webgl = {"\"shininess\":32.0}", "\"shininess\":33.0}"}},
    Mutation{.name = "everything is grey",
             .cpp = {"255.0f * encoded(std::min(std::max(x, 0.0f), 1.0f)) + 0.5f", "127.0f + 0 * x"},
             .opengl = {"pixel = vec4(", "pixel = vec4(0.5) + 0.0 * vec4("},
             .webgl = {"pixel = vec4(", "pixel = vec4(0.5) + 0.0 * vec4("}},
    Mutation{.name = "nothing is drawn",
             .cpp = k_gone,
             .opengl = k_gone,
             .webgl = {"pixel = vec4(", "discard; pixel = vec4("}},
    Mutation{.name = "red and green are swapped",
             .cpp = {"{p.x, p.y, p.z}", "{p.y, p.x, p.z}"},
             .opengl = k_swapped,
             .webgl = k_swapped},
    Mutation{.name = "a light is missing",
             .cpp = {"vec3(1.0f), 2.0f", "vec3(0.0f), 2.0f"},
             .opengl = {"{\"point_light_count\", Uniform::whole, {2, 0, 0}}",
                        "{\"point_light_count\", Uniform::whole, {1, 0, 0}}"},
             .webgl = {"\"intensity\":2.0", "\"intensity\":0.0"}},
    Mutation{.name = "light fades by distance instead of its square",
             .cpp = k_attenuated,
             .opengl = k_attenuated,
             .webgl = k_attenuated},
    Mutation{.name = "normals point inwards", .cpp = k_flipped, .opengl = k_flipped, .webgl = k_flipped},
    Mutation{.name = "intensities are not encoded as sRGB",
             .cpp = {"255.0f * encoded(", "255.0f * ("},
             .opengl = k_linear,
             .webgl = k_linear},
    Mutation{.name = "ambient light is left out",
             .cpp = k_no_ambient,
             .opengl = k_no_ambient,
             .webgl = k_no_ambient},
    Mutation{
        .name = "the picture is displaced by a row",
        .cpp = {"{x + static_cast<double>(offset.x), y +", "{x + static_cast<double>(offset.x), y + 1 +"},
        .opengl = k_below,
        .webgl = k_below},
    Mutation{.name = "the field of view is larger by 0.1 %",
             .cpp = {"k_field_of_view = 40;", "k_field_of_view = 40.04;"},
             .opengl = {"true, 40.0f}", "true, 40.04f}"},
             .webgl = {"\"fov\":40.0", "\"fov\":40.04"}},
    Mutation{.name = "highlights have the object's colour",
             .cpp = k_metallic,
             .opengl = k_metallic,
             .webgl = k_metallic},
    Mutation{.name = "highlights are clamped at nine tenths",
             .cpp = k_clamped,
             .opengl = k_clamped,
             .webgl = k_clamped},
};
static_assert(k_mutations.size() == 15);

/// A receding floor, a ball, and a wall larger than its picture, with a picture of soft waves and grain.
constexpr const char* k_textured_scene = R"(version = 1
observer = {position = [0, 1.2, 4], look_at = [0, 0, 0], fov = 45}
image = {width = 240, height = 180}
room = {width = 100, height = 100, depth = 100}
shading = {model = "phong"}
reflection = {model = "lambert"}
light = [
    {type = "ambient", intensity = 0.5},
    {type = "directional", direction = [-0.3, -1, -0.6], intensity = 0.6},
]
object = [
    {name = "floor", type = "mesh", file = "floor.obj", color = {texture = "picture.ppm"}},
    {name = "ball", type = "sphere", radius = 0.8, position = [0, 0.3, 0], color = {texture = "picture.ppm"}},
    {name = "wall", type = "mesh", file = "floor.obj", color = {texture = "picture.ppm", wrap = "clamp", wrap_v = "mirror"}, rotation = [90, 0, 0], scale = [0.2, 0.2, 0.2], position = [0, -0.3, -2.5]},
]
)";
constexpr const char* k_floor =
    "v -9 -1 3\nv 9 -1 3\nv 9 -1 -30\nv -9 -1 -30\nvt -2.2 -0.7\nvt 2.7 -0.7\nvt 2.7 6.1\nvt -2.2 6.1\n"
    "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";

/// 8 bits per channel, with `size` pixels per side.
std::string waves_ppm(int size) {
    std::string file = fmt::format("P6\n{0} {0}\n255\n", size);
    std::uint32_t grain = 1;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            constexpr double k_turn = 2 * std::numbers::pi;
            const double wave = std::sin(k_turn * x / size) * std::cos(k_turn * y / size + 0.5);
            for (int c = 0; c < 3; ++c) {
                grain = grain * 1664525u + 1013904223u;
                file += static_cast<char>(130 + 12 * c + 40 * wave + static_cast<int>(grain >> 29));
            }
        }
    }
    return file;
}

// Texture lookup is the same text in all three programs.
constexpr std::array k_texture_mutations = {
    std::pair{"texels are displaced by half a texel", Edit{"float(width) - 0.5f", "float(width)"}},
    std::pair{"a level too coarse", Edit{"min(level, last)", "min(level + 1.0f, last)"}},
    std::pair{"a level too fine", Edit{"min(level, last)", "max(min(level, last) - 1.0f, 0.0f)"}},
    std::pair{"the shorter side of a footprint decides",
              Edit{"max(dot(a, a), dot(b, b))", "min(dot(a, a), dot(b, b))"}},
    std::pair{"levels are not blended", Edit{"wanted - floor(wanted))", "0.0f)"}},
    std::pair{"nothing repeats", Edit{"wrap == 0 ? repeated", "wrap == 0 ? x + min(repeated, 0.0f)"}},
    std::pair{"nothing is clamped", Edit{"(wrap == 1 ? x : mirrored)", "(wrap == 1 ? repeated : mirrored)"}},
    std::pair{"nothing is mirrored",
              Edit{"(wrap == 1 ? x : mirrored)", "(wrap == 1 ? x : repeated + min(mirrored, 0.0f))"}},
    std::pair{"u decides how v continues",
              Edit{"color_texture_wrapped(uv.y, t.wrap_v)", "color_texture_wrapped(uv.y, t.wrap_u)"}},
    std::pair{"pictures are upside down", Edit{"(1.0f - color_texture_wrapped(uv.y, t.wrap_v))",
                                               "color_texture_wrapped(uv.y, t.wrap_v)"}},
};

#ifndef CANDELA_TEST_SHADERS
/// A coarse ball and a bent sheet over a floor. A light is below the ball's shadow, and one is not blocked.
constexpr const char* k_shadow_scene = R"(version = 1
observer = {position = [0, 1.6, 4.4], look_at = [0, -0.3, 0], fov = 45}
image = {width = 240, height = 180}
room = {width = 20, height = 20, depth = 20}
shading = {model = "phong"}
reflection = {model = "lambert"}
shadows = {enabled = true}
light = [
    {type = "ambient", intensity = 0.4, ambient_occlusion_rays = 8, ambient_occlusion_distance = 1.5},
    {type = "point", position = [-1.5, 2, 1], intensity = 3},
    {type = "point", position = [1, -0.6, 2.5], intensity = 0.5, casts_shadows = false},
    {type = "distributed", position = [1, 2, 0], edge_u = [1, 0, 0.4], samples_u = 4, intensity = 3},
]
object = [
    {name = "floor", type = "mesh", file = "floor.obj"},
    {name = "ball", type = "sphere", radius = 0.6, segments = 9, position = [-0.9, -0.3, 0]},
    {name = "sheet", type = "mesh", file = "sheet.obj", position = [0.9, -0.95, 0]},
    {name = "ghost", type = "cube", size = 0.4, position = [0, -0.7, 1.4], casts_shadows = false},
    {name = "pale", type = "cube", size = 0.4, position = [0.1, -0.79, -0.6], receives_shadows = false},
]
)";
constexpr const char* k_shadow_floor = "v -3 -1 -3\nv -3 -1 3\nv 3 -1 3\nv 3 -1 -3\nf 1 2 3 4\n";
constexpr const char* k_sheet =
    "v -0.5 0 0.3\nv 0 0 0\nv 0.5 0 0.3\nv -0.5 1 0.3\nv 0 1 0\nv 0.5 1 0.3\nf 1 2 5 4\nf 2 3 6 5\n";

constexpr std::array k_shadow_mutations = {
    std::pair{"light is blocked where it leaves",
              Edit{"object->is_solid) return enters", "object->is_solid) return !enters"}},
    std::pair{"solid objects block on both sides",
              Edit{"object->is_solid) return enters", "object->is_solid) return true"}},
    std::pair{"open surfaces block on one side only",
              Edit{"object->is_solid) return enters", "object->is_solid || true) return enters"}},
    std::pair{"a light behind which something stands is blocked",
              Edit{"float length = distance", "float length = k_infinitely_far + distance"}},
    std::pair{"rays start at the surface", Edit{"return 0x1p-20f *", "return 0.0f *"}},
    std::pair{"all lights cast shadows", Edit{"= {true, false}", "= {true, true}"}},
    std::pair{"all objects cast shadows", Edit{"o.casts_shadows = false", "o.casts_shadows = true"}},
    std::pair{"all objects receive shadows", Edit{"o.receives_shadows = false", "o.receives_shadows = true"}},
    std::pair{"penumbras have steps", Edit{"- offset.x * part.u", "- 0.0f * offset.x * part.u"}},
    std::pair{"samples vary differently", Edit{"at.pixel.x * 3679390609u", "at.pixel.y * 3679390609u"}},
    std::pair{"ambient occlusion reaches too far", Edit{"{8, 1.5f}", "{8, 3.0f}"}},
    std::pair{"rays of ambient occlusion are not turned", Edit{"0.61803399f * k", "0.0f * k"}},
};
static_assert(k_shadow_mutations.size() == 12);
#endif

/// Replaces all occurrences. None is an error of this test, because the fault would be missing.
std::string edited(std::string text, const Edit& edit) {
    INFO("no longer in the program: " << edit.from);
    REQUIRE(holds(text, std::string(edit.from)));
    for (std::size_t at = 0; (at = text.find(edit.from, at)) != std::string::npos; at += edit.to.size())
        text.replace(at, edit.from.size(), edit.to);
    return text;
}

/// External headers, which are most of what a compiler reads, are compiled once for all programs in this
/// folder.
void precompile_headers(const fs::path& program, const std::string& source, const std::string& optimization) {
    std::string headers;
    std::istringstream lines(source);
    for (std::string line; std::getline(lines, line);) {
        constexpr std::string_view k_include = "#include <";
        if (line.starts_with(k_include)) headers += " " + line.substr(k_include.size() - 1);
    }
    const fs::path cmake = program / "CMakeLists.txt";
    write_file(cmake, fmt::format("{}target_precompile_headers(scene PRIVATE{})\n"
                                  "target_compile_options(scene PRIVATE {} -Werror)\n",
                                  read_file(cmake), headers, optimization));
}

/// A fault by its name.
using Fault = std::pair<const char*, Edit>;

/// `scene`: a file. The program's text is in `file`.
void expect_caught(const std::string& target, const std::string& scene, const std::string& file,
                   const std::vector<Fault>& faults) {
    const fs::path program = fs::path(scene).parent_path() / "program";
    succeeded(run_candela({"generate", scene, "--target", target, "-o", program.string()}));
    const std::string sound = read_file(program / file);
    // OpenGL's picture does not depend on the optimisation of the program.
    if (target != "webgl") precompile_headers(program, sound, target == "cpp" ? "-O1" : "-O0");
    const auto verified = [&] {
        return run_candela({"verify", scene, "--target", target, "--program", program.string()});
    };
    succeeded(verified());
    for (const auto& [name, edit] : faults) {
        write_file(program / file, edited(sound, edit));
        const CommandResult result = verified();
        INFO(name << '\n' << result.out << result.err);
        CHECK(result.exit_code == 4);
    }
}

void expect_all_caught(const std::string& target, const std::string& file, Edit Mutation::* edit) {
    const std::string scene = write_file(scratch_directory() / "scene.toml", k_scene).string();
    std::vector<Fault> faults;
    for (const Mutation& mutation : k_mutations) faults.emplace_back(mutation.name, mutation.*edit);
    expect_caught(target, scene, file, faults);
}

void expect_all_caught_of_textures(const std::string& target, const std::string& file) {
    const fs::path folder = scratch_directory();
    write_file(folder / "floor.obj", k_floor);
    write_file(folder / "picture.ppm", waves_ppm(128));
    const std::string scene = write_file(folder / "scene.toml", k_textured_scene).string();
    expect_caught(target, scene, file, {k_texture_mutations.begin(), k_texture_mutations.end()});
}

#ifndef CANDELA_TEST_SHADERS
void expect_all_caught_of_shadows(const std::string& target, const std::string& file) {
    const fs::path folder = scratch_directory();
    write_file(folder / "floor.obj", k_shadow_floor);
    write_file(folder / "sheet.obj", k_sheet);
    const std::string scene = write_file(folder / "scene.toml", k_shadow_scene).string();
    expect_caught(target, scene, file, {k_shadow_mutations.begin(), k_shadow_mutations.end()});
}
#endif

}  // namespace

#ifdef CANDELA_TEST_SHADERS
TEST_CASE("verify: fifteen faults of an OpenGL program are caught") {
    expect_all_caught("opengl", "scene.cpp", &Mutation::opengl);
}

TEST_CASE("verify: fifteen faults of a page are caught") {
    expect_all_caught("webgl", "scene.html", &Mutation::webgl);
}

TEST_CASE("verify: ten faults of the textures of an OpenGL program are caught") {
    expect_all_caught_of_textures("opengl", "scene.cpp");
}

TEST_CASE("verify: ten faults of the textures of a page are caught") {
    expect_all_caught_of_textures("webgl", "scene.html");
}
#else
TEST_CASE("verify: fifteen faults of a C++ program are caught") {
    expect_all_caught("cpp", "scene.cpp", &Mutation::cpp);
}

TEST_CASE("verify: ten faults of the textures of a C++ program are caught") {
    expect_all_caught_of_textures("cpp", "scene.cpp");
}

TEST_CASE("verify: twelve faults of the shadows of a C++ program are caught") {
    expect_all_caught_of_shadows("cpp", "scene.cpp");
}
#endif
