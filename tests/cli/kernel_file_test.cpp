// Kernel files in the place of models' names: in scenes, on the command line, and in every command.
#include <sys/stat.h>

#include <catch2/catch_test_macros.hpp>
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "support/box_scene.h"
#include "support/command.h"
#include "support/expect.h"
#include "support/scene_tables.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

/// Lambert's law under another name, with half of its diffuse coefficient.
constexpr const char* k_half = R"(/// # Half
/// Half of Lambert's light.
///
/// $$ I_d = \frac{k_d}{2} C_o I_L \max(N \cdot L, 0) $$
struct HalfMaterial {
    vec3 ka;  /// = 0.1 [0, 1]: how much ambient light is reflected
    vec3 kd;  /// = 0.35 [0, 1]: twice the share of light that is reflected
};

KERNEL vec3 half_reflect_ambient(HalfMaterial m, Surface s) {
    return m.ka * s.color;
}

KERNEL Reflected half_reflect(HalfMaterial m, Surface s, vec3 to_light) {
    return Reflected(m.kd * s.color * max(dot(s.normal, to_light), 0.0f), vec3(0.0f));
}
)";

constexpr const char* k_lamp = R"(struct LampLight {
    vec3 position;  /// point in m: where it is
};

KERNEL Incident lamp_illuminate(LampLight light, Receiver r) {
    return point_source(light.position, vec3(1.0f), 1.0f, 2, 0.0f, r);
}
)";

struct Workspace {
    Workspace() : directory(scratch_directory()) {
        write_file(directory / "half.kernel", k_half);
        write_file(directory / "lamp.kernel", k_lamp);
        write_file(directory / "scene.toml", scene("reflection = \"half.kernel\"", "point"));
    }

    static std::string scene(const std::string& reflection, const std::string& light) {
        return k_start + image_table(40, 30) + "[[light]]\ntype = \"" + light +
               "\"\nposition = [2, 2, 3]\n"
               "[[object]]\ntype = \"sphere\"\nname = \"ball\"\nshading = \"flat\"\n" +
               reflection + "\n";
    }

    CommandResult candela(const Words& words, const std::string& path = "") const {
        // One cache for all tests: the kernels are the same.
        CommandSetup setup{
            .environment = {{"XDG_CACHE_HOME", (directory.parent_path() / "kernel_cache").string()}},
            .directory = directory};
        if (!path.empty()) setup.environment.emplace_back("PATH", path);
        return run_candela(words, setup);
    }
    std::string image(const Words& words) const {
        Words all = words;
        all.insert(all.end(), {"-o", "picture.ppm"});
        fs::remove(directory / "picture.ppm");
        succeeded(candela(all));
        return read_file(directory / "picture.ppm");
    }

    fs::path directory;
};

}  // namespace

TEST_CASE("a kernel file is a reflection model, in a scene and on the command line", "[kernel_files]") {
    const Workspace place;
    write_file(place.directory / "lambert.toml",
               Workspace::scene("reflection = \"lambert\"\nmaterial = { kd = 0.35 }", "point"));
    const std::string lambert = place.image({"render", "lambert.toml"});
    CHECK(place.image({"render", "scene.toml"}) == lambert);
    CHECK(place.image({"render", "lambert.toml", "--reflection", "./half.kernel"}) == lambert);
    CHECK(place.image({"render", "scene.toml", "--set", "object.ball.material.kd=0.7"}) != lambert);

    // In a scene, the path is relative to the scene's file.
    write_file(place.directory / "below/scene.toml",
               Workspace::scene("reflection = \"../half.kernel\"", "point"));
    CHECK(place.image({"render", "below/scene.toml"}) == lambert);
    const CommandResult printed = place.candela({"check", "scene.toml", "--print"});
    CHECK(holds(printed.out, "\"" + (place.directory / "half.kernel").string() + "\""));
}

TEST_CASE("a kernel file is a light", "[kernel_files]") {
    const Workspace place;
    write_file(place.directory / "point.toml",
               Workspace::scene("reflection = \"lambert\"", "point\"\nattenuation = \"none"));
    write_file(place.directory / "lamp.toml", Workspace::scene("reflection = \"lambert\"", "lamp.kernel"));
    CHECK(place.image({"render", "lamp.toml"}) == place.image({"render", "point.toml"}));
}

TEST_CASE("what is beyond a kernel file's light blocks it unless the kernel says how far the light is",
          "[kernel_files]") {
    const Workspace place;
    write_file(place.directory / "near/lamp.kernel",
               std::string(k_lamp) +
                   "\nKERNEL float lamp_distance(LampLight light, Receiver r) {\n"
                   "    return length(light.position - r.position);\n}\n");
    // On the other side of the light, behind the observer.
    const auto scene = [](const std::string& light) {
        return Workspace::scene("reflection = \"lambert\"", light) +
               "[[object]]\ntype = \"cube\"\nposition = [3, 3, 4.4]\nsize = 1.1\nshading = \"flat\"\n"
               "reflection = \"lambert\"\n";
    };
    write_file(place.directory / "point.toml", scene("point\"\nattenuation = \"none"));
    write_file(place.directory / "lamp.toml", scene("lamp.kernel"));
    write_file(place.directory / "near.toml", scene("near/lamp.kernel"));
    const std::string lit = place.image({"render", "point.toml", "--shadows"});
    CHECK(place.image({"render", "near.toml", "--shadows"}) == lit);
    CHECK(place.image({"render", "lamp.toml", "--no-shadows"}) == lit);
    CHECK(place.image({"render", "lamp.toml", "--shadows"}) != lit);
}

TEST_CASE("a kernel file's light with an extent has a penumbra", "[kernel_files]") {
    const Workspace place;
    const std::string punctual =
        std::string(k_lamp) +
        "\nKERNEL Punctual lamp_punctual(LampLight light) {\n"
        "    return punctual_source(light.position, vec3(1.0f), 1.0f, 2, 0.0f);\n}\n";
    write_file(place.directory / "lamp.kernel", punctual);
    write_file(place.directory / "wide/lamp.kernel",
               punctual +
                   "\nKERNEL Extent lamp_extent(LampLight light) {\n"
                   "    return Extent(vec3(0.8f, 0.0f, 0.0f), vec3(0.0f, 0.8f, 0.0f));\n}\n");
    // A small box before the light, and a ball in whose pixels, not faces, light is evaluated.
    const auto scene = [](const std::string& light) {
        return k_start + image_table(40, 30) + models("phong", "lambert") + "[[light]]\ntype = \"" + light +
               "\"\nposition = [2, 2, 3]\n[[object]]\ntype = \"sphere\"\n"
               "[[object]]\ntype = \"cube\"\nposition = [1.4, 1.4, 2.1]\nsize = 0.3\n";
    };
    write_file(place.directory / "lamp.toml", scene("lamp.kernel"));
    write_file(place.directory / "wide.toml", scene("wide/lamp.kernel"));
    CHECK(place.image({"render", "wide.toml", "--no-shadows"}) ==
          place.image({"render", "lamp.toml", "--no-shadows"}));
    const std::string hard = place.image({"render", "lamp.toml", "--shadows"});
    CHECK(place.image({"render", "wide.toml", "--shadows"}) != hard);
    CHECK(place.image({"render", "wide.toml", "--shadows", "--set", "shadows.pattern=fixed"}) == hard);
}

TEST_CASE("commands that take a model's name take a kernel file", "[kernel_files]") {
    const Workspace place;
    const CommandResult described = place.candela({"describe", "half.kernel"});
    CHECK(holds(described.out, "I_d = k_d / 2 C_o I_L max(N.L, 0)"));
    CHECK(holds(described.out, "twice the share of light that is reflected"));
    for (const Words& words :
         {Words{"plot", "half.kernel", "reflection/lambert", "-o", "lobe.svg"},
          Words{"plot", "lamp.kernel", "-o", "lamp.csv"},
          Words{"compare", "scene.toml", "--reflection", "half.kernel,lambert", "-o", "sheet.ppm"},
          Words{"explain", "scene.toml", "--pixel", "20,15"},
          Words{"generate", "scene.toml", "--target", "cpp", "-o", "program"},
          Words{"generate", "scene.toml", "--target", "webgl", "-o", "page"},
          Words{"exercise", "new", "half.kernel", "--blank", "reflect", "-o", "exercise.html"},
          Words{"check", "scene.toml"}}) {
        const CommandResult result = place.candela(words);
        INFO(words.front() << ": " << result.err);
        CHECK(result.exit_code == 0);
    }
    CHECK(holds(read_file(place.directory / "program/scene.cpp"), "KERNEL Reflected half_reflect("));
}

TEST_CASE("a kernel file conforms like an installed plugin", "[kernel_files]") {
    const Workspace place;
    const CommandResult result = place.candela({"plugin", "test", "half.kernel"});
    INFO(result.out << result.err);
    CHECK(result.exit_code == 0);
    CHECK(holds(result.out, "It conforms"));
}

TEST_CASE("an exercise about a kernel file has its functions, and is graded where the file is",
          "[kernel_files]") {
    const Workspace place;
    write_file(
        place.directory / "plain.kernel",
        "KERNEL float plain_share(float x) { return 0.5f * x; }\n"
        "KERNEL Reflected plain_reflect(Surface s, vec3 to_light) {\n"
        "    return Reflected(vec3(plain_share(max(dot(s.normal, to_light), 0.0f))), vec3(0.0f));\n}\n");
    expect(
        place.candela({"exercise", "new", "plain.kernel", "--blank", "reflect_ambient", "-o", "page.html"}),
        2, {"has no function 'reflect_ambient'", "(possible: share, reflect)"});
    CHECK(!fs::exists(place.directory / "page.html"));
    succeeded(place.candela({"exercise", "new", "plain.kernel", "--blank", "share", "-o", "page.html"}));

    write_file(
        place.directory / "an.answer",
        R"({"candela_exercise": 1, "model": "plain.kernel", "function": "plain_share", "answer": ["return x / 2.0;"]})");
    const CommandResult here = place.candela({"exercise", "grade", "an.answer"});
    INFO(here.out << here.err);
    CHECK(here.exit_code == 0);
    Workspace elsewhere = place;
    elsewhere.directory /= "elsewhere";
    fs::create_directory(elsewhere.directory);
    const CommandResult there =
        elsewhere.candela({"exercise", "grade", (place.directory / "an.answer").string()});
    CHECK(there.exit_code == 4);
    CHECK(holds(
        there.out,
        "'plain.kernel', which does not exist in this folder; run the command where the exercise was made"));
}

TEST_CASE("the kit tells rounding at the flank of a highlight from a model that is not reciprocal",
          "[kernel_files]") {
    const Workspace place;
    // Ashikhmin and Shirley's specular part as their paper has it: H.L one way is H.V the other, up to
    // rounding.
    const std::string paper = R"(/// properties: reciprocal
struct PaperMaterial {
    float exponent;  /// = 1000 [0, 10000]: of the highlight
};

KERNEL Reflected paper_reflect(PaperMaterial m, Surface s, vec3 to_light) {
    vec3 h = normalize(to_light + SHARE * s.to_observer);
    float n_dot_l = max(dot(s.normal, to_light), 0.0f);
    float n_dot_v = max(dot(s.normal, s.to_observer), 1.0e-4f);
    float lobe = (m.exponent + 1.0f) * clamped_power(dot(s.normal, h), m.exponent);
    return Reflected(vec3(0.0f), vec3(n_dot_l * lobe / (max(dot(h, to_light), 1.0e-4f) * max(n_dot_l, n_dot_v))));
}
)";
    const auto verdict_on = [&](const std::string& share) {
        std::string text = paper;
        write_file(place.directory / "paper.kernel", text.replace(text.find("SHARE"), 5, share));
        return place.candela({"plugin", "test", "paper.kernel", "--check", "reciprocal"});
    };
    const CommandResult exact = verdict_on("1.0f"), uneven = verdict_on("1.0001f");
    INFO(exact.out << uneven.out);
    CHECK(exact.exit_code == 0);
    CHECK(uneven.exit_code == 4);
    CHECK(holds(uneven.out, "it is not reciprocal"));
    CHECK(holds(uneven.out, "while rounding explains a difference of"));
}

TEST_CASE("mistakes in a kernel file are shown with its line and a mark", "[kernel_files]") {
    const Workspace place;
    std::string wrong = k_half;
    wrong.replace(wrong.find("max(dot"), 7, "max(dott");
    write_file(place.directory / "half.kernel", wrong);
    const CommandResult in_scene = place.candela({"render", "scene.toml"});
    CHECK(in_scene.exit_code == 3);
    CHECK(holds(in_scene.err, (place.directory / "half.kernel").string() +
                                  ":15:43: error: unknown function 'dott'\n   15 |     return "));
    CHECK(holds(in_scene.err,
                "\n      |                                           ^^^^ did you mean 'dot'?\n"));
    CHECK(holds(in_scene.err.substr(in_scene.err.find("dott") + 100), "error:") == false);
    const CommandResult named = place.candela({"describe", "half.kernel"});
    CHECK(named.exit_code == 3);
    CHECK(holds(named.err, "half.kernel:15:43: error: unknown function 'dott'\n"));
    CHECK(holds(named.err, "^^^^ did you mean 'dot'?\n"));

    for (const auto& [text, problem] :
         {std::pair{"#include </etc/passwd>\n",
                    "half.kernel:1:1: error: the kernel language has no preprocessor"},
          std::pair{"KERNEL float f(float x) { return x; }\n",
                    "half.kernel:1:1: error: a model named 'half' needs a function half_reflect"},
          std::pair{"/// requires: a\nKERNEL vec3 half_normal(ShadingPoint p) { return p.face_normal; }\n",
                    "half.kernel:1:16: error: expected 'a <= b because"}}) {
        write_file(place.directory / "half.kernel", text);
        const CommandResult result = place.candela({"describe", "half.kernel"});
        CHECK(result.exit_code == 3);
        INFO(result.err);
        CHECK(holds(result.err, problem));
    }
}

TEST_CASE("a kernel file that cannot be used says why", "[kernel_files]") {
    const Workspace place;
    const auto error_of = [&](const Words& words, const std::string& path = "") {
        const CommandResult result = place.candela(words, path);
        CHECK(result.exit_code != 0);
        return result.err;
    };
    CHECK(holds(error_of({"render", "--reflection", "none.kernel"}), "'none.kernel' does not exist"));
    CHECK(holds(error_of({"render", "--reflection", "lamp.kernel"}),
                "'lamp.kernel' is a light model; expected a reflection model"));
    write_file(place.directory / "Big.kernel", k_half);
    CHECK(holds(error_of({"render", "--reflection", "Big.kernel"}), "is not a valid name of a model's file"));
    std::string other = k_half;
    other.insert(0, "// no compiler has seen this\n");
    write_file(place.directory / "half.kernel", other);
    fs::create_directories(place.directory / "empty");
    CHECK(holds(error_of({"render", "scene.toml"}, (place.directory / "empty").string()),
                "a kernel needs a C++ compiler, and none is installed (packages g++ or clang)"));
}

namespace {

/// A workspace whose compiled kernels no other test has.
struct CachedWorkspace : Workspace {
    CommandResult check(const std::string& kernel) const {
        return run_candela({"check", "scene.toml", "--reflection", kernel},
                           {.environment = {{"XDG_CACHE_HOME", cache.string()}}, .directory = directory});
    }
    std::vector<fs::path> compiled() const {
        std::vector<fs::path> folders;
        for (const auto& entry : fs::directory_iterator(cache / "candela/kernels"))
            folders.push_back(entry.path());
        return folders;
    }
    /// The only one that has been compiled.
    fs::path library() const {
        const std::vector<fs::path> folders = compiled();
        REQUIRE(folders.size() == 1);
        return folders.front() / "reflection-half.so";
    }
    fs::path cache = directory / "cache";
};

}  // namespace

TEST_CASE("a kernel is compiled once, wherever its file is, and again when its text has changed",
          "[kernel_files]") {
    const CachedWorkspace place;
    succeeded(place.check("half.kernel"));
    const auto made = fs::last_write_time(place.library());
    write_file(place.directory / "below/half.kernel", k_half);
    for (const std::string& path : Words{"half.kernel", "./half.kernel", "below/half.kernel",
                                         (place.directory / "half.kernel").string()}) {
        succeeded(place.check(path));
        CHECK(fs::last_write_time(place.library()) == made);
    }
    write_file(place.directory / "half.kernel", std::string(k_half) + "// another text\n");
    succeeded(place.check("half.kernel"));
    CHECK(place.compiled().size() == 2);
}

TEST_CASE("a compiled kernel that was damaged is compiled again", "[kernel_files]") {
    const CachedWorkspace place;
    succeeded(place.check("half.kernel"));
    const fs::path library = place.library();
    const auto size = fs::file_size(library);
    const auto is_mended = [&] {
        succeeded(place.check("half.kernel"));
        return place.library() == library && fs::file_size(library) == size;
    };
    fs::resize_file(library, size / 2);
    CHECK(is_mended());
    fs::remove(library);
    CHECK(is_mended());
    fs::remove(library.parent_path() / "reflection-half.json");
    CHECK(is_mended());
}

TEST_CASE("a compiled kernel that has not been used for a month is removed", "[kernel_files]") {
    const CachedWorkspace place;
    const auto weeks_ago = [](int weeks) {
        return fs::file_time_type::clock::now() - std::chrono::hours(24 * 7 * weeks);
    };
    succeeded(place.check("half.kernel"));
    const fs::path old = place.library().parent_path();
    fs::last_write_time(old, weeks_ago(5));
    succeeded(place.check("half.kernel"));  // uses it
    CHECK(fs::last_write_time(old) > weeks_ago(1));
    fs::last_write_time(old, weeks_ago(5));
    write_file(place.directory / "half.kernel", std::string(k_half) + "// another text\n");
    succeeded(place.check("half.kernel"));
    CHECK(place.compiled().size() == 1);
    CHECK(!fs::exists(old));
}

TEST_CASE("a cache that cannot be written is a failure that says how to choose another", "[kernel_files]") {
    const CachedWorkspace place;
    write_file(place.cache, "a file");
    expect(place.check("half.kernel"), 1, {"compiled kernels cannot be kept in", "XDG_CACHE_HOME"});
}

namespace {

/// A scene whose material has a key that only half.kernel, changed accordingly, knows.
void use_own_key(const Workspace& place) {
    std::string kernel = k_half;
    kernel.replace(kernel.find("vec3 kd"), 7, "vec3 amount");
    kernel.replace(kernel.find("m.kd"), 4, "m.amount");
    write_file(place.directory / "half.kernel", kernel);
    write_file(place.directory / "scene.toml",
               Workspace::scene("reflection = \"half.kernel\"\nmaterial = { amount = 0.5 }", "point"));
}

}  // namespace

TEST_CASE("a scene with a kernel file's material can be switched to another model", "[kernel_files]") {
    const Workspace place;
    use_own_key(place);
    write_file(place.directory / "phong.toml", Workspace::scene("reflection = \"phong\"", "point"));
    write_file(
        place.directory / "table.toml",
        Workspace::scene("material = { amount = 0.5 }\n[reflection]\nmodel = \"half.kernel\"", "point"));
    const std::string phong = place.image({"render", "phong.toml"});
    CHECK(place.image({"render", "scene.toml", "--reflection", "phong"}) == phong);
    CHECK(place.image({"render", "table.toml", "--reflection", "phong"}) == phong);
    succeeded(
        place.candela({"compare", "scene.toml", "--reflection", "phong,./half.kernel", "-o", "sheet.ppm"}));
    const Words wrong{"check", "scene.toml", "--reflection",
                      "phong", "--set",      "object.ball.material.amoumt=1"};
    expect(place.candela(wrong), 3, {"unknown key 'amoumt' in [object.material] of 'ball'"});

    // Nobody knows what a broken kernel reads.
    write_file(place.directory / "half.kernel", "struct");
    expect(place.candela({"check", "scene.toml", "--reflection", "phong"}), 0,
           {"scene.toml:", "warning: 'half.kernel' cannot be used, so it is unknown which material keys"});
    expect(place.candela({"check", "scene.toml"}), 3, {"half.kernel:1:"});
}

TEST_CASE("a kernel that cannot be read is an error of the scene that names it, or a failure",
          "[kernel_files]") {
    const Workspace place;
    fs::create_directories(place.directory / "folder.kernel");
    REQUIRE(::mkfifo((place.directory / "pipe.kernel").c_str(), 0600) == 0);
    for (const auto& [file, reason] :
         {std::pair{"haft.kernel", "'haft.kernel' does not exist"},
          std::pair{"folder.kernel", "'folder.kernel' is a directory, not a file"},
          std::pair{"pipe.kernel", "'pipe.kernel' is not a regular file"}}) {
        write_file(place.directory / "scene.toml",
                   Workspace::scene(std::string("reflection = \"") + file + "\"", "point"));
        const CommandResult checked = place.candela({"check", "scene.toml"});
        expect(checked, 3, {"scene.toml:15:14: error: ", reason});
        for (const Words& words :
             {Words{"describe", file}, Words{"plot", file}, Words{"plugin", "test", file}})
            expect(place.candela(words), 1, {reason});
    }
    write_file(place.directory / "scene.toml", Workspace::scene("reflection = \"haft.kernel\"", "point"));
    expect(place.candela({"check", "scene.toml"}), 3,
           {"did you mean 'half.kernel'?  (looked for " + (place.directory / "haft.kernel").string() + ")"});
}

TEST_CASE("without a compiler that works, a kernel is a failure, not an error of the scene",
          "[kernel_files]") {
    const Workspace place;
    write_file(place.directory / "half.kernel", std::string("// for a compiler that fails\n") + k_half);
    const auto checked_with = [&](const std::string& compiler) {
        CommandSetup setup{.input = "",
                           .environment = {{"XDG_CACHE_HOME", (place.directory / "cache").string()}},
                           .directory = place.directory};
        setup.environment.emplace_back(compiler.empty() ? "PATH" : "CXX",
                                       compiler.empty() ? (place.directory / "empty").string() : compiler);
        return run_candela({"check", "scene.toml"}, setup);
    };
    fs::create_directories(place.directory / "empty");
    expect(checked_with(""), 1,
           {"a kernel needs a C++ compiler, and none is installed (packages g++ or clang)"});
    expect(checked_with("/bin/false"), 1, {"/bin/false could not compile the kernel: it gave no reason"});
    expect(checked_with("nosuch"), 1, {"CXX names the C++ compiler 'nosuch', which is not installed"});
}

TEST_CASE("messages call a kernel file by its path", "[kernel_files]") {
    const Workspace place;
    expect(place.candela({"check", "scene.toml", "--set", "object.ball.material.kx=1"}), 3,
           {"unknown key 'kx' in [object.material] of 'ball'", "(candela describe half.kernel)"});
    expect_out(place.candela({"describe", "half.kernel"}), 0, {"Half (half.kernel), version 0"});
    expect_out(place.candela({"check", "scene.toml", "--shading", "phong"}), 0,
               {"phong shading, half.kernel reflection\n"});
    expect_out(place.candela({"explain", "scene.toml", "--pixel", "20,15"}), 0,
               {" half.kernel reflection\n"});
}

TEST_CASE("a parameter that a kernel file does not have, or a name without .kernel, is explained",
          "[kernel_files]") {
    const Workspace place;
    expect(place.candela({"plot", "half.kernel:kx=3"}), 2,
           {"half.kernel:kx: unknown key 'kx' in half.kernel", "(candela describe half.kernel)"});
    for (const Words& words :
         {Words{"describe", "../half"}, Words{"plot", "half.txt"}, Words{"plot", "../half"},
          Words{"check", "scene.toml", "--reflection", "half.txt"}})
        CHECK(holds(place.candela(words).err, "; the name of a kernel file ends with .kernel"));
    for (const Words& words : {Words{"check", "scene.toml", "--reflection", "reflection/phong"},
                               Words{"check", "scene.toml", "--set", "object.ball.type=ball.obj"}})
        CHECK(!holds(place.candela(words).err, "ends with .kernel"));
}

TEST_CASE("two kernels of one name cannot be in one program", "[kernel_files]") {
    const Workspace place;
    fs::create_directories(place.directory / "other");
    write_file(place.directory / "other/half.kernel", std::string(k_half) + "\n");
    write_file(place.directory / "scene.toml",
               Workspace::scene("reflection = \"half.kernel\"\n[[object]]\nname = \"ring\"\ntype = "
                                "\"torus\"\nposition = [2, 0, 0]\nshading = \"flat\"\nreflection = "
                                "\"other/half.kernel\"",
                                "point"));
    for (const Words& words : {Words{"generate", "scene.toml", "--target", "webgl", "-o", "page"},
                               Words{"verify", "scene.toml", "--target", "cpp"}}) {
        const CommandResult result = place.candela(words);
        expect(result, 1,
               {"object 'ring': the reflection models 'half.kernel' and 'other/half.kernel' have kernel "
                "functions of the same names"});
        CHECK(!holds(result.err, "--models"));
    }
}

TEST_CASE("a shading model in a kernel file can be in a generated program", "[kernel_files]") {
    const Workspace place;
    write_file(place.directory / "smooth.kernel",
               "KERNEL vec3 smooth_normal(ShadingPoint p) { return normalize(p.vertex_normal); }\n");
    succeeded(place.candela({"generate", "scene.toml", "--target", "webgl", "-o", "page", "--shading",
                             "./smooth.kernel", "--models", "half.kernel,phong"}));
    CHECK(holds(read_file(place.directory / "page/scene.html"), "\"id\":\"smooth.kernel\""));
}

TEST_CASE("a diagnostic of a kernel has a length and a hint, as any other", "[kernel_files]") {
    const Workspace place;
    std::string wrong = k_half;
    wrong.replace(wrong.find("max(dot"), 7, "max(dott");
    write_file(place.directory / "half.kernel", wrong);
    expect_out(
        place.candela({"check", "scene.toml", "--json"}), 3,
        {"\"length\": 4", "\"message\": \"unknown function 'dott'\"", "\"hint\": \"did you mean 'dot'?\""});
}

TEST_CASE("help says where a kernel file can be named", "[kernel_files]") {
    const Workspace place;
    for (const Words& words :
         {Words{"describe", "--help"}, Words{"plot", "--help"}, Words{"compare", "--help"},
          Words{"plugin", "test", "--help"}, Words{"exercise", "new", "--help"}}) {
        const std::string help = place.candela(words).out;
        INFO(help);
        CHECK((holds(help, "FILE.kernel") || holds(help, "kernel file")));
    }
}
