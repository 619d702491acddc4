// candela import: the animations of glTF files.
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/gltf_file.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::json;

/// A glTF file: boxes of 1 x 1 x 1 m around the origins of their nodes, each with a material of its own.
class File : public GltfFile {
  public:
    File()
        : GltfFile({{"scenes", {{{"nodes", Json::array()}}}},
                    {"nodes", Json::array()},
                    {"meshes", Json::array()},
                    {"materials", Json::array()}}) {
        std::vector<float> corners;
        for (std::size_t i = 0; i < 8; ++i)
            for (std::size_t k = 0; k < 3; ++k) corners.push_back((i >> k & 1) != 0 ? 0.5f : -0.5f);
        position_ = floats("VEC3", corners);
        const std::vector<std::uint8_t> indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                                   2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
        indices_ = accessor(k_ubyte, "SCALAR", indices.size(), indices);
    }

    /// Adds a node and returns it.
    std::size_t box(const std::string& material, Json node = Json::object()) {
        json["materials"].push_back({{"name", material}});
        node["mesh"] = mesh(json["materials"].size() - 1);
        return add(std::move(node));
    }
    std::size_t mesh(std::size_t material) {
        json["meshes"].push_back(
            {{"primitives",
              {{{"attributes", {{"POSITION", position_}}}, {"indices", indices_}, {"material", material}}}}});
        return json["meshes"].size() - 1;
    }
    std::size_t add(Json node, bool is_root = true) {
        json["nodes"].push_back(std::move(node));
        const std::size_t index = json["nodes"].size() - 1;
        if (is_root) json["scenes"][0]["nodes"].push_back(index);
        return index;
    }

    void animate(std::size_t node, const char* path, const std::vector<float>& times,
                 const std::vector<float>& values, const char* interpolation = "LINEAR") {
        if (!json.contains("animations"))
            json["animations"] = {{{"channels", Json::array()}, {"samplers", Json::array()}}};
        Json& animation = json["animations"][0];
        const std::size_t in = floats("SCALAR", times);
        const std::size_t out = floats(std::string(path) == "rotation" ? "VEC4" : "VEC3", values);
        animation["samplers"].push_back({{"input", in}, {"output", out}, {"interpolation", interpolation}});
        animation["channels"].push_back(
            {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
    }

  private:
    std::size_t position_ = 0, indices_ = 0;
};

/// A rotation about y, in glTF's notation.
std::array<float, 4> about_y(double degrees) {
    const double half = degrees * std::numbers::pi / 360;
    return {0, static_cast<float>(std::sin(half)), 0, static_cast<float>(std::cos(half))};
}

std::vector<float> turns_about_y(const std::vector<double>& degrees) {
    std::vector<float> result;
    for (const double each : degrees)
        for (const float x : about_y(each)) result.push_back(x);
    return result;
}

CommandResult import(const Folder& folder, const std::string& name) {
    const CommandResult result =
        succeeded(folder.run_words({"import", name + ".gltf", "-o", name + ".toml"}));
    expect(folder.run_words({"check", name + ".toml"}), 0);
    return result;
}

/// The three numbers after `key`, after `section`, in the output of `check --print` for a frame.
std::array<double, 3> vector_in(const Folder& folder, const std::string& scene, int frame,
                                const std::string& section, const std::string& key) {
    const CommandResult printed =
        succeeded(folder.run_words({"check", scene + ".toml", "--print", "--frame", std::to_string(frame)}));
    INFO(printed.out);
    const std::size_t start = printed.out.find(section);
    REQUIRE(start != std::string::npos);
    std::size_t at = printed.out.find("\n" + key, start);
    REQUIRE(at != std::string::npos);
    at = printed.out.find('[', at);
    std::array<double, 3> result{};
    const char* next = printed.out.c_str() + at + 1;
    for (double& x : result) {
        char* end = nullptr;
        x = std::strtod(next, &end);
        next = end + 1;
    }
    return result;
}

void check_near(const std::array<double, 3>& is, const std::array<double, 3>& should, double tolerance) {
    for (std::size_t k = 0; k < 3; ++k) {
        INFO(k << ": " << is[k] << " and " << should[k]);
        CHECK(std::abs(is[k] - should[k]) <= tolerance);
    }
}

/// How many channels of the pixels differ by more than a level.
std::size_t differing(const std::string& a, const std::string& b) {
    REQUIRE(a.size() == b.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (std::abs(static_cast<unsigned char>(a[i]) - static_cast<unsigned char>(b[i])) > 1) ++count;
    return count;
}

}  // namespace

TEST_CASE("a moving node becomes tracks of its object, relative to its rest position") {
    const Folder folder;
    File file;
    file.box("still", {{"translation", {-3, 0, 0}}});
    const std::size_t box = file.box("moves", {{"translation", {1, 0, 0}}});
    file.animate(box, "translation", {0, 1, 2}, {1, 0, 0, 1, 2, 0, 5, 2, 0});
    file.write(folder, "a");
    const CommandResult imported = import(folder, "a");
    CHECK(holds(imported.err, "its animation is imported for 1 object\n"));
    const std::string scene = folder.read("a.toml");
    CHECK(holds(scene, "frames = 49\n"));
    CHECK(holds(scene, "\"object.moves.position\""));
    CHECK_FALSE(holds(scene, ".rotation\""));
    CHECK_FALSE(holds(scene, ".scale\""));
    CHECK_FALSE(holds(scene, "object.still"));
    check_near(vector_in(folder, "a", 12, "\"moves\"", "position"), {0, 1, 0}, 1e-6);
    check_near(vector_in(folder, "a", 36, "\"moves\"", "position"), {2, 2, 0}, 1e-6);
    check_near(vector_in(folder, "a", 48, "\"moves\"", "position"), {4, 2, 0}, 1e-6);
    expect(folder.run("animate a.toml -o f/%03d.ppm --step 24 --width 40 --height 30"), 0);
    CHECK(fs::exists(folder / "f" / "048.ppm"));
}

TEST_CASE("a node that turns about its own pivot looks like one resting at that position") {
    const Folder folder;
    const auto file_at = [](double degrees) {
        File file;
        const auto q = about_y(degrees);
        const std::size_t pivot =
            file.add({{"translation", {2, 0, 1}}, {"rotation", {q[0], q[1], q[2], q[3]}}});
        file.box("box", {{"translation", {1.5, 0.5, 0}}, {"scale", {1, 2, 0.5}}});
        file.json["nodes"][pivot]["children"] = {1};
        file.json["scenes"][0]["nodes"] = {pivot};
        return file;
    };
    File moving = file_at(20);
    // 300 degrees in two seconds, there and back by the shorter ways.
    moving.animate(0, "rotation", {0, 0.5f, 1, 2}, turns_about_y({20, 140, 260, 320}));
    moving.write(folder, "moving");
    import(folder, "moving");
    const auto image = [&](const std::string& name, const std::string& scene, int frame) {
        succeeded(folder.run_words({"render",   scene,
                                    "-o",       name,
                                    "--frame",  std::to_string(frame),
                                    "--width",  "120",
                                    "--height", "90",
                                    "--set",    "observer.position=[7,5,9]",
                                    "--set",    "observer.look_at=[2,0,1]",
                                    "--set",    "room.width=60",
                                    "--set",    "room.height=60",
                                    "--set",    "room.depth=60"}));
        return folder.read(name);
    };
    for (const auto& [frame, degrees] :
         {std::pair{0, 20.0}, {6, 80.0}, {12, 140.0}, {17, 190.0}, {36, 290.0}}) {
        const std::string name = "still" + std::to_string(frame);
        file_at(degrees == 190.0 ? 140 + 120 * (17.0 / 24 - 0.5) / 0.5 : degrees).write(folder, name);
        import(folder, name);
        const std::string is = image("is.ppm", "moving.toml", frame);
        const std::string should = image("should.ppm", name + ".toml", 0);
        INFO(frame);
        // Edges are off by hundredths of a pixel, so some samples there differ.
        CHECK(differing(is, should) < 200);
    }
}

TEST_CASE("a model in place of a scene is shown at rest by render and animated by animate") {
    const Folder folder;
    File still, moving;
    still.box("box", {{"translation", {1, 0, 0}}});
    still.write(folder, "still");
    // Its rest position does not occur in its animation.
    moving.animate(moving.box("box", {{"translation", {1, 0, 0}}}), "translation", {0, 1},
                   {0, 3, 0, 0, 4, 0});
    moving.write(folder, "moving");
    const auto words = [](const Words& of) { return joined(of, {"--width", "40", "--height", "30"}); };
    succeeded(folder.run_words(words({"render", "still.gltf", "-o", "still.ppm"})));
    const CommandResult rest =
        succeeded(folder.run_words(words({"render", "moving.gltf", "-o", "rest.ppm"})));
    CHECK(holds(rest.err, "its animation is left out; the model is shown at rest"));
    CHECK(folder.read("still.ppm") == folder.read("rest.ppm"));
    import(folder, "moving");
    succeeded(folder.run_words(words({"render", "moving.toml", "-o", "a.ppm", "--frame", "24"})));
    succeeded(folder.run_words(words({"render", "moving.gltf", "-o", "b.ppm", "--frame", "24"})));
    CHECK(folder.read("a.ppm") == folder.read("b.ppm"));
    expect(folder.run_words(words({"animate", "moving.gltf", "-o", "%03d.ppm", "--frames", "24..24"})), 0);
    CHECK(folder.read("024.ppm") == folder.read("a.ppm"));
}

TEST_CASE("steps, splines and rotations beyond 180 degrees are followed") {
    const Folder folder;
    File file;
    const std::size_t jumps = file.box("jumps"), swings = file.box("swings"), turns = file.box("turns"),
                      both = file.box("both");
    file.animate(jumps, "translation", {0, 0.5f, 1}, {0, 0, 0, 0, 3, 0, 0, 5, 0}, "STEP");
    // Tangents of 6 m/s at both ends of a second: x = 6 (s3 - 2 s2 + s) + 6 (s3 - s2).
    file.animate(swings, "translation", {0, 1}, {0, 0, 0, 0, 0, 0, 6, 0, 0, 6, 0, 0, 0, 0, 0, 0, 0, 0},
                 "CUBICSPLINE");
    file.animate(turns, "rotation", {0, 0.25f, 0.5f, 0.75f, 1}, turns_about_y({0, 100, 200, 300, 400}));
    file.animate(both, "translation", {0, 1}, {0, 0, 0, 4, 0, 0});
    file.animate(both, "scale", {0, 0.5f}, {2, 2, 1, 2, 3, 4}, "STEP");
    file.write(folder, "a");
    CHECK(holds(import(folder, "a").err, "for 4 objects, with linear pieces for its splines\n"));
    check_near(vector_in(folder, "a", 11, "\"jumps\"", "position"), {0, 0, 0}, 0);
    check_near(vector_in(folder, "a", 12, "\"jumps\"", "position"), {0, 3, 0}, 0);
    check_near(vector_in(folder, "a", 24, "\"jumps\"", "position"), {0, 5, 0}, 0);
    for (const int frame : {5, 6, 13, 18, 22}) {
        const double s = frame / 24.0;
        check_near(vector_in(folder, "a", frame, "\"swings\"", "position"),
                   {6 * (s * s * s - 2 * s * s + s) + 6 * (s * s * s - s * s), 0, 0}, 2e-3);
    }
    for (const int frame : {3, 6, 13, 20, 24})
        check_near(vector_in(folder, "a", frame, "\"turns\"", "rotation"), {0, 400.0 * frame / 24, 0}, 0.1);
    check_near(vector_in(folder, "a", 11, "\"both\"", "scale"), {2, 2, 1}, 1e-6);
    check_near(vector_in(folder, "a", 12, "\"both\"", "scale"), {2, 3, 4}, 1e-6);
    check_near(vector_in(folder, "a", 18, "\"both\"", "position"), {3, 0, 0}, 1e-3);
}

TEST_CASE("the camera and lights move with their nodes") {
    const Folder folder;
    File file;
    file.box("box");
    file.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"aspectRatio", 1.5}}}}};
    file.json["extensionsUsed"] = {"KHR_lights_punctual"};
    file.json["extensions"] = {
        {"KHR_lights_punctual", {{"lights", {{{"type", "point"}, {"name", "lamp"}, {"intensity", 100}}}}}}};
    const std::size_t pivot = file.add({{"children", {2}}});
    file.add({{"camera", 0}, {"translation", {0, 0, 6}}}, false);
    const std::size_t lamp =
        file.add({{"translation", {0, 4, 0}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    file.animate(pivot, "rotation", {0, 1}, turns_about_y({0, 90}));
    file.animate(lamp, "translation", {0, 1}, {0, 4, 0, 0, 4, 40});
    file.write(folder, "a");
    CHECK(holds(import(folder, "a").err, "for the camera, 1 light\n"));
    for (const int frame : {0, 7, 12, 24}) {
        const double angle = frame / 24.0 * std::numbers::pi / 2;
        check_near(vector_in(folder, "a", frame, "[observer]", "position"),
                   {6 * std::sin(angle), 0, 6 * std::cos(angle)}, 3e-3);
        check_near(vector_in(folder, "a", frame, "[observer]", "look_at"), {0, 0, 0}, 0.02);
    }
    check_near(vector_in(folder, "a", 12, "\"lamp\"", "position"), {0, 4, 20}, 1e-4);
}

TEST_CASE("motions that tracks cannot describe are left at rest and counted") {
    const Folder folder;
    File file;
    const std::size_t moves = file.box("moves");
    file.animate(moves, "translation", {0, 1}, {0, 0, 0, 1, 0, 0});
    // A material on two nodes, one of which moves.
    const std::size_t shared = file.box("shared", {{"translation", {0, 2, 0}}});
    file.add({{"mesh", file.json["nodes"][shared]["mesh"]}, {"translation", {0, 4, 0}}});
    file.animate(shared, "translation", {0, 1}, {0, 2, 0, 1, 2, 0});
    // Sheared: rotated within a node that is stretched along one axis.
    const std::size_t sheared = file.box("sheared");
    file.add({{"scale", {1, 1, 3}}, {"children", {sheared}}});
    file.json["scenes"][0]["nodes"].erase(3);
    file.animate(sheared, "rotation", {0, 1}, turns_about_y({0, 45}));
    file.json["animations"].push_back({{"name", "Run"}, {"channels", Json::array()}});
    file.write(folder, "a");
    const CommandResult imported = import(folder, "a");
    CHECK(holds(imported.err,
                "its first animation is imported for 1 object; left out: 1 object whose pieces move "
                "apart, 1 motion that position, rotation and scale cannot describe, the animation 'Run'\n"));
    const std::string scene = folder.read("a.toml");
    CHECK_FALSE(holds(scene, "object.shared"));
    CHECK_FALSE(holds(scene, "object.sheared"));
}

TEST_CASE("an animation that cannot be read is left out") {
    const Folder folder;
    File file;
    const std::size_t box = file.box("box");
    file.animate(box, "translation", {1, 0}, {0, 0, 0, 1, 0, 0});  // times do not increase
    file.animate(box, "rotation", {0, 1}, {0, 0, 0, 1});           // a value is missing
    file.animate(box, "scale", {0, 1}, {1, 1, 1, 0, 0, 0});        // the node vanishes
    file.write(folder, "a");
    CHECK(holds(import(folder, "a").err, "its animation is left out; the model is shown at rest"));
    CHECK_FALSE(holds(folder.read("a.toml"), "animation]"));
    file.json["animations"][0]["samplers"][0]["input"] = 4000000000u;
    file.json["animations"][0]["channels"][1]["target"]["node"] = 77;
    file.json["accessors"].back()["count"] = 4000000000u;
    file.write(folder, "b");
    CHECK(holds(import(folder, "b").err, "its animation is left out; the model is shown at rest"));
}

TEST_CASE("an object that leaves the frame is visible on its way, and the room contains it") {
    const Folder folder;
    File file;
    file.animate(file.box("box"), "translation", {0, 1}, {0, 0, 0, 40, 0, 0});
    file.write(folder, "a");
    import(folder, "a");
    for (const char* const frame : {"0", "24"}) {
        REQUIRE(folder
                    .run_words({"render", "a.toml", "-o", "a.ppm", "--frame", frame, "--width", "80",
                                "--height", "60"})
                    .exit_code == 0);
        const std::string ppm = folder.read("a.ppm");
        const std::string pixels = ppm.substr(ppm.size() - std::size_t{3} * 80 * 60);
        std::size_t seen = 0;
        for (std::size_t i = 0; i < pixels.size(); i += 3)
            if (pixels.substr(i, 3) != pixels.substr(0, 3)) ++seen;
        INFO(frame);
        CHECK(seen > 1);
    }
}
