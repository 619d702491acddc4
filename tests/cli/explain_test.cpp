// candela explain: compares its steps with the worked examples of the rendering-equation notes (RE) and with
// formulas written here, and its bytes with pictures.
#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/text.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

struct Explained {
    json json_text;
    const json& point() const { return json_text.at("fragments").at(0).at("points").at(0); }
    /// The explanation of the light of that name.
    const json& light(const std::string& label) const {
        for (const json& light : point().at("lights")) {
            if (light.at("light") == "'" + label + "'") return light;
        }
        FAIL("unknown light " << label);
        return json_text;
    }
};

/// Explains a pixel of a scene that may have the mesh face.obj.
Explained explained(const std::string& scene, const std::string& mesh, const std::string& pixel) {
    const fs::path folder = scratch_directory();
    write_file(folder / "face.obj", mesh);
    const std::string file = write_file(folder / "scene.toml", scene).string();
    const std::vector<std::string> arguments{"explain", file, "--pixel", pixel, "--json", "--quiet"};
    const CommandResult result = succeeded(run_candela(arguments));
    return {json::parse(result.out)};
}

/// The value of a step by its name, in the called function (depth 0) or in one that it calls.
const json& value(const json& steps, const std::string& name, int depth = 0) {
    for (const json& step : steps) {
        if (step.at("name") == name && step.at("depth") == depth && step.contains("value"))
            return step.at("value");
    }
    FAIL("unknown step " << name << " in " << steps.dump(1));
    return steps;
}

/// To four decimals, as in the notes.
void check_vector(const json& actual, double x, double y, double z, double margin = 6e-5) {
    INFO(actual.dump());
    CHECK(actual.at(0).get<double>() == Catch::Approx(x).margin(margin));
    CHECK(actual.at(1).get<double>() == Catch::Approx(y).margin(margin));
    CHECK(actual.at(2).get<double>() == Catch::Approx(z).margin(margin));
}
void check_number(const json& actual, double expected, double margin = 6e-5) {
    CHECK(actual.get<double>() == Catch::Approx(expected).margin(margin));
}

struct Face {
    std::string corners;  // three lines of an OBJ file
    std::string light;    // position
    std::string observer;
    std::string look_at = "[0, 0, 0]";
};

/// The pixel in the middle of a view of a triangle in a large room, with the material of RE's third example
/// and flat shading, so that light is evaluated at its centroid.
Explained explained(const Face& face) {
    return explained("version = 1\n[room]\nwidth = 60\nheight = 60\ndepth = 60\n[observer]\nposition = " +
                         face.observer + "\nlook_at = " + face.look_at +
                         "\n[image]\nwidth = 33\nheight = 33\ncolor_management = \"none\"\n"
                         "[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = " +
                         face.light +
                         "\nattenuation = \"offset-linear\"\nattenuation_offset = 0.01\n"
                         "[[light]]\nname = \"sky\"\ntype = \"ambient\"\nintensity = 0.3\n"
                         "[[object]]\ntype = \"mesh\"\nfile = \"face.obj\"\ncolor = [255, 255, 255]\n"
                         "material = { ka = 0.1, kd = 0.8, ks = 0.2, shininess = 10 }\n"
                         "[shading]\nmodel = \"flat\"\n[reflection]\nmodel = \"phong\"\n",
                     face.corners + "f 1 2 3\n", "16,16");
}

}  // namespace

// RE's three examples are at a corner of the face, or at a point without a face; here the face is moved so
// that its centroid is that point. Orientation and lights are those of the notes.

TEST_CASE("the first worked example of RE is explained: R for a light at (-4, 2, 0) and N = (0, 1, 0)") {
    const Explained e = explained({.corners = "v 1 0 1\nv 0 0 -2\nv -1 0 1\n",
                                   .light = "[-4, 2, 0]",
                                   .observer = "[0, 5, 1]",
                                   .look_at = "[0, 0, 0]"});
    check_vector(e.point().at("position"), 0, 0, 0);
    check_vector(e.point().at("N"), 0, 1, 0);
    check_vector(e.light("lamp").at("L"), -0.8944, 0.4472, 0);
    check_vector(e.light("lamp").at("R"), 0.8944, 0.4472, 0);
    // The kernel's own line, "vec3 r = 2.0f * n_dot_l * s.normal - to_light;".
    check_vector(value(e.light("lamp").at("reflection_steps"), "r"), 0.8944, 0.4472, 0);
}

TEST_CASE("the second worked example of RE is explained: cosines of 0.7071 and 0.8575") {
    const Explained e = explained({.corners = "v 1.6666667 0 -1.6666667\nv -3.3333333 0 -1.6666667\n"
                                              "v 1.6666667 0 3.3333333\n",
                                   .light = "[-10, 10, 0]",
                                   .observer = "[20, 5, 0]",
                                   .look_at = "[0, 0, 0]"});
    check_vector(e.point().at("position"), 0, 0, 0);
    check_vector(e.point().at("N"), 0, 1, 0);
    check_number(e.light("lamp").at("N.L"), 0.7071);
    const json& steps = e.light("lamp").at("reflection_steps");
    check_number(value(steps, "n_dot_l"), 0.7071);
    check_number(value(steps, "base", 1), 0.8575);  // the argument of clamped_power(): R.V
    check_number(value(steps, "highlight"), std::pow(0.8575, 10));
}

// RE sees the face from behind, where R.V is negative and it has no highlight; from the front, R.V is 0.5514.
// The notes round after each step, hence the margin; the numbers that follow from the positions in double
// precision must agree to seven digits.
TEST_CASE("the third worked example of RE is explained: N, L, R and the red intensity 0.4353") {
    constexpr double k_rounded = 1.5e-4;
    // V1 + (V2 - V1), V1 + (V3 - V1), V1 - both: the centroid is V1 = (.7, .1, .4).
    const Explained e = explained({.corners = "v 0.1 0.2 0.2\nv 0.5 0.3 0.5\nv 1.5 -0.2 0.5\n",
                                   .light = "[0.3, 0.8, 0.4]",
                                   .observer = "[0.7, 0.1, -4]\nprojection = \"orthographic\"\nheight = 1",
                                   .look_at = "[0.7, 0.1, 0.4]"});
    check_vector(e.point().at("position"), 0.7, 0.1, 0.4);
    check_vector(e.point().at("N"), 1.0 / 3, 2.0 / 3, -2.0 / 3);
    const json& lamp = e.light("lamp");
    check_vector(lamp.at("L"), -0.4962, 0.8683, 0, k_rounded);
    check_number(lamp.at("N.L"), 0.4135);
    check_vector(lamp.at("R"), 0.7719, -0.3169, -0.5514, k_rounded);
    check_number(value(lamp.at("reflection_steps"), "base", 1), 0.5514, k_rounded);
    check_number(value(lamp.at("light_steps"), "distance", 1), 0.8062);
    check_number(lamp.at("diffuse").at(0), 1 / (0.8062 + 0.01));
    check_number(e.light("sky").at("I_a").at(0), 0.03);
    const double red = lamp.at("I_d").at(0).get<double>() + e.point().at("I_a").at(0).get<double>();
    check_number(red, 0.4353, k_rounded);

    const double distance = std::sqrt(0.65), n_dot_l = (-0.4 / 3 + 0.7 * 2 / 3) / distance;
    const double diffuse = 0.8 * n_dot_l / (distance + 0.01), highlight = std::pow(4.0 / 3 * n_dot_l, 10);
    const double specular = 0.2 * highlight / (distance + 0.01), sum = diffuse + specular + 0.03;
    check_number(lamp.at("N.L"), n_dot_l, 1e-6);
    check_number(lamp.at("I_d").at(0), diffuse, 1e-6);
    check_number(lamp.at("I_s").at(0), specular, 1e-6);
    check_number(e.json_text.at("I").at(0), sum, 1e-6);
    CHECK(e.json_text.at("bytes").at(0) == std::lround(255 * sum));
}

TEST_CASE("a step is a statement of the kernel, with its file, line and text") {
    const Explained e = explained({.corners = "v 1 0 1\nv 0 0 -2\nv -1 0 1\n",
                                   .light = "[-4, 2, 0]",
                                   .observer = "[0, 5, 1]",
                                   .look_at = "[0, 0, 0]"});
    const std::string kernel = read_file(fs::path(CANDELA_TEST_SOURCE) / "plugins/reflection/phong.kernel");
    const std::string statement = "float n_dot_l = dot(s.normal, to_light)";
    const auto line =
        1 + std::count(kernel.begin(), kernel.begin() + static_cast<long>(kernel.find(statement)), '\n');
    bool is_there = false;
    for (const json& step : e.light("lamp").at("reflection_steps")) {
        if (step.at("name") != "n_dot_l") continue;
        is_there = true;
        CHECK(step.at("text") == statement);
        CHECK(step.at("file") == "phong.kernel");
        CHECK(step.at("line") == line);
    }
    CHECK(is_there);
    // The text, compiled again, computes the same as the plugin.
    CHECK(e.json_text.at("kernel_difference").get<double>() < 1e-5);
}

TEST_CASE("an explanation as text has the same numbers and ends with the byte") {
    const CommandResult result = succeeded(run_candela({"explain", "--pixel", "256,320"}));
    INFO(result.out);
    CHECK(result.out.starts_with("pixel 256,320 of 512 x 512: "));
    CHECK(holds(result.out, "phong.kernel:"));
    CHECK(holds(result.out, "float n_dot_l = dot(s.normal, to_light);"));
    CHECK(holds(result.out, "phong shading: light is evaluated once per pixel"));
    const json same = json::parse(run_candela({"explain", "--pixel", "256,320", "--json"}).out);
    CHECK(holds(result.out, "byte " + same.at("bytes").at(0).dump()));
}

TEST_CASE("a kernel's table is named, not printed as a list") {
    const CommandResult result =
        succeeded(run_candela({"explain", "--pixel", "256,320", "--set", "light.lamp.type=ies", "--set",
                               "light.lamp.direction=[0, -1, -1]"}));
    CHECK(holds(result.out, "light.file = a table"));
}

TEST_CASE("without a compiler, explain says so and reports the renderer's data") {
    const CommandResult result = expect_out(
        run_candela({"explain", "--pixel", "256,320"}, {.environment = {{"PATH", "/nowhere"}, {"CXX", ""}}}),
        0, {"the kernels' steps are left out: no C++ compiler is installed", "N.L = "});
    CHECK_FALSE(holds(result.out, "n_dot_l"));
}

TEST_CASE("a pixel without an object is explained by the background") {
    const json e =
        json::parse(run_candela({"explain", "--pixel", "0,0", "--set", "image.background=[10, 20, 30]",
                                 "--set", "observer.look_at=[0, 9, 0]", "--json"})
                        .out);
    CHECK(e.at("fragments").empty());
    CHECK(e.at("background_weight") == 1);
    CHECK(e.at("bytes") == json({10, 20, 30}));
}

TEST_CASE("a pixel outside the picture is a usage error that gives the valid range") {
    expect(run_candela({"explain"}), 2);
    for (const char* const pixel :
         {"512,0", "0,512", "-1,0", "3", "a,b", "1,2,3", "", "1;2", "99999999999,0"}) {
        INFO(pixel);
        const CommandResult result = run_candela({"explain", std::string("--pixel=") + pixel});
        CHECK(result.exit_code == 2);
        CHECK(result.out.empty());
    }
    CHECK(holds(run_candela({"explain", "--pixel", "512,0"}).err, "0,0 to 511,511"));
}

TEST_CASE("kept kernels explain other pixels without a compiler, with the same results") {
    const fs::path directory = scratch_directory(), kept = directory / "kept";
    fs::create_directory(kept);
    const auto explained_at = [&](const char* pixel, bool is_kept, bool has_compiler) {
        std::vector<std::string> words{"explain", "--pixel", pixel, "--json", "--quiet"};
        if (is_kept) words.insert(words.end(), {"--keep", kept.string()});
        CommandSetup setup;
        if (!has_compiler) setup.environment = {{"PATH", "/nowhere"}, {"CXX", ""}};
        const CommandResult result = succeeded(run_candela(words, setup));
        return json::parse(result.out);
    };
    const json alone = explained_at("256,300", false, true);
    REQUIRE_FALSE(alone.at("kernel_difference").is_null());
    CHECK(explained_at("256,300", true, true) == alone);
    CHECK(explained_at("256,300", true, false) == alone);
    CHECK(explained_at("250,290", true, false) == explained_at("250,290", false, true));
    // A folder that others may write to, or a link to one, may contain anybody's program.
    const fs::path program = fs::directory_iterator(kept)->path();
    fs::permissions(program, fs::perms::group_write, fs::perm_options::add);
    CHECK(explained_at("256,300", true, false).at("kernel_difference").is_null());
    fs::permissions(program, fs::perms::group_write, fs::perm_options::remove);
    fs::rename(program, directory / "elsewhere");
    fs::create_symlink(directory / "elsewhere", program);
    CHECK(explained_at("256,300", true, false).at("kernel_difference").is_null());
    // A program made from another source is not used.
    fs::remove(program);
    CHECK(explained_at("256,300", true, true) == alone);
    for (const fs::directory_entry& each : fs::directory_iterator(kept))
        write_file(each.path() / "kernels.cpp", "another");
    CHECK(explained_at("256,300", true, false).at("kernel_difference").is_null());
    expect(run_candela({"explain", "--pixel=1,1", "--keep", (kept / "nowhere").string()}), 1,
           {"is not a folder"});
}

TEST_CASE(
    "pixels on standard input are explained line by line, like each of them alone; invalid lines are "
    "errors") {
    CommandSetup setup{.input = "256,300\n9,9\nnothing\nno UTF-8: \xff\n512,0\n250,290\n"};
    const CommandResult all = run_candela({"explain", "--pixel", "-", "--json", "--quiet"}, setup);
    CHECK(all.exit_code == 2);
    std::istringstream lines(all.out);
    const auto next = [&] {
        std::string line;
        REQUIRE(std::getline(lines, line));
        return json::parse(line);
    };
    const auto alone = [](const char* pixel) {
        return json::parse(run_candela({"explain", "--pixel", pixel, "--json", "--quiet"}).out);
    };
    CHECK(next() == alone("256,300"));
    CHECK(next() == alone("9,9"));
    CHECK(holds(next().at("error").get<std::string>(), "'nothing'"));
    CHECK(holds(next().at("error").get<std::string>(), "'no UTF-8: \xef\xbf\xbd'"));
    CHECK(holds(next().at("error").get<std::string>(), "0,0 to 511,511"));
    CHECK(next() == alone("250,290"));
    CHECK(lines.peek() == std::istringstream::traits_type::eof());

    setup.input = "nothing\n256,300\n";
    const CommandResult for_a_person =
        expect(run_candela({"explain", "--pixel", "-", "--quiet"}, setup), 2, {"'nothing'"});
    CHECK(for_a_person.out == run_candela({"explain", "--pixel", "256,300", "--quiet"}).out);
}
