// No verb overwrites its inputs, whatever the name of its output.
#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/scene_tables.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

constexpr const char* k_animation =
    "[animation]\nframes = 2\n[[animation.track]]\npath = \"object.mesh.rotation\"\n"
    "keys = [[0, [0, 0, 0]], [1, [0, 9, 0]]]\n";

/// The inputs have names that a picture may also have.
Folder folder_with_scene() {
    const Folder d;
    for (const std::string environment : {"", "environment = \"sky.ppm\"\n"})
        write_file(d / (environment.empty() ? "plain.ppm" : "scene.ppm"),
                   "include = [\"part.ppm\"]\n" + k_start + k_models + k_animation + image_table(8, 8) +
                       environment +
                       "[[object]]\nname = \"mesh\"\ntype = \"mesh\"\nfile = \"model.gltf\"\n"
                       "color = { texture = \"texture.ppm\" }\n");
    d.write("part.ppm", "[[light]]\ntype = \"ambient\"\n");
    for (const char* const name : {"sky.ppm", "texture.ppm", "texture.normal.ppm", "frame1.ppm"})
        d.write(name, "P6\n1 1\n255\nabc");
    d.write("model.gltf",
            R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
    "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
    "textures": [{"source": 0}], "images": [{"uri": "pic%20ture.ppm"}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
                  {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
    "buffers": [{"byteLength": 60, "uri": "buffer.ppm"}]})");
    std::string buffer(60, '\0');
    buffer.replace(12, 4, std::string("\0\0\x80\x3f", 4));
    buffer.replace(28, 4, std::string("\0\0\x80\x3f", 4));
    d.write("buffer.ppm", buffer);
    d.write("pic ture.ppm", "P6\n1 1\n255\nabc");
    d.write("model.obj",
            "mtllib my library.ppm\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n");
    d.write("my library.ppm", "newmtl a\nKd 1 0 0\nmap_Kd -s 1 1 1 wood.ppm\n");
    d.write("wood.ppm", "P6\n1 1\n255\nabc");
    fs::create_directory(d / "sub");
    return d;
}

std::map<std::string, std::string> contents_of(const Folder& directory) {
    std::map<std::string, std::string> contents;
    for (const auto& entry : fs::directory_iterator(directory))
        if (entry.is_regular_file()) contents[entry.path().filename().string()] = read_file(entry.path());
    return contents;
}

/// The files that are changed or new.
std::string changes_in(const Folder& directory, const std::map<std::string, std::string>& before) {
    const std::map<std::string, std::string> after = contents_of(directory);
    std::string changes;
    for (const auto& [name, content] : after)
        if (!before.contains(name) || before.at(name) != content) changes += name + "; ";
    for (const auto& [name, content] : before)
        if (!after.contains(name)) changes += "no " + name + "; ";
    return changes;
}

/// Other names of a file.
std::vector<std::string> spellings_of(const Folder& directory, const std::string& name) {
    fs::create_symlink(name, directory / ("soft-" + name));
    fs::create_hard_link(directory / name, directory / ("hard-" + name));
    return {name, "./" + name, "sub/../" + name, (directory / name).string(), "soft-" + name, "hard-" + name};
}

struct Attempt {
    std::vector<std::string> words;  // "OUTPUT" stands for the file's name
    std::vector<std::string> inputs;
};

std::vector<std::string> with_output(std::vector<std::string> words, const std::string& name) {
    for (std::string& word : words)
        if (const auto at = word.find("OUTPUT"); at != std::string::npos) word.replace(at, 6, name);
    return words;
}

}  // namespace

TEST_CASE("no verb overwrites a file that it reads, by whatever name or link") {
    const Folder d = folder_with_scene();
    const std::vector<std::string> scene{"scene.ppm", "part.ppm", "sky.ppm", "texture.ppm", "buffer.ppm"};
    const std::vector<std::string> obj{"my library.ppm", "wood.ppm", "model.obj"},
        gltf{"buffer.ppm", "pic ture.ppm", "model.gltf"};
    std::map<std::string, std::vector<std::string>> names;
    for (const auto& inputs : {scene, obj, gltf, {"plain.ppm"}})
        for (const std::string& input : inputs)
            if (!names.contains(input)) names[input] = spellings_of(d, input);
    const std::map<std::string, std::string> before = contents_of(d);
    for (const Attempt& attempt : {
             Attempt{{"render", "scene.ppm", "-o", "OUTPUT"}, scene},
             Attempt{{"render", "scene.ppm", "-o", "OUTPUT", "--part", "1/2"}, scene},
             Attempt{{"compare", "scene.ppm", "-o", "OUTPUT", "--reflection", "phong,lambert"}, scene},
             Attempt{{"submit", "scene.ppm", "-o", "OUTPUT", "--parts", "2", "--engine", "print"}, scene},
             Attempt{{"generate", "plain.ppm", "--target", "webgl", "-o", "page", "--inputs", "OUTPUT"},
                     {"plain.ppm", "part.ppm", "texture.ppm", "buffer.ppm"}},
             Attempt{{"diff", "texture.ppm", "sky.ppm", "-o", "OUTPUT"}, {"texture.ppm", "sky.ppm"}},
             Attempt{{"diff", "texture.ppm", "sky.ppm", "--decoded", "OUTPUT"}, {"texture.ppm", "sky.ppm"}},
             Attempt{{"diff", "texture.ppm", "sky.ppm", "--mask", "part.ppm", "-o", "OUTPUT"}, {"part.ppm"}},
             Attempt{{"import", "model.obj", "-o", "OUTPUT", "--force"}, obj},
             Attempt{{"import", "model.gltf", "-o", "OUTPUT", "--force"}, gltf},
         }) {
        for (const std::string& input : attempt.inputs) {
            for (const std::string& name : names.at(input)) {
                const CommandResult result = d.run_words(with_output(attempt.words, name));
                INFO(attempt.words[0] << ' ' << name << ": " << result.err);
                CHECK(result.exit_code == 2);
                CHECK(holds(result.err, " another name"));
                CHECK(changes_in(d, before) == "");
            }
        }
    }
}

TEST_CASE("files that a verb names itself, such as terms and frames, do not overwrite inputs either") {
    const Folder d = folder_with_scene();
    const std::map<std::string, std::string> before = contents_of(d);
    const auto textured = [](const std::string& file) {
        return "object.mesh.color={ texture = \"" + file + "\" }";
    };
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"render", "scene.ppm", "-o", "texture.ppm", "--terms", "normal", "--set",
              textured("texture.normal.ppm")},
             {"animate", "scene.ppm", "-o", "frame%d.ppm", "--set", textured("frame1.ppm")},
             {"submit", "scene.ppm", "-o", "frame%d.ppm", "--engine", "print", "--set",
              textured("frame1.ppm")}}) {
        const CommandResult result = d.run_words(words);
        INFO(words[0] << ": " << result.err);
        CHECK(result.exit_code == 2);
        CHECK(holds(result.err, "is one of the files that the scene is made from"));
        CHECK(changes_in(d, before) == "");
    }
}

TEST_CASE("a task's journal is not a user option, and overwrites only journals") {
    const Folder d = folder_with_scene();
    const std::map<std::string, std::string> before = contents_of(d);
    for (const std::string verb : {"render", "animate", "assemble"})
        expect(d.run_words({verb, "scene.ppm", "--journal", "scene.ppm"}), 2, {"unknown option '--journal'"});
    expect(d.run("--task scene.ppm render scene.ppm -o picture.png"), 2,
           {"'scene.ppm' is not the journal of a task"});
    CHECK(changes_in(d, before) == "");
    expect(d.run("--task journal render -o picture.png"), 0);
    expect(d.run("--task journal render -o picture.png"), 0);
}

TEST_CASE("any existing file is kept with --no-clobber, before any work is done") {
    const Folder d = folder_with_scene();
    for (const char* const name : {"mine.png", "mine.svg", "mine.html", "mine.ppm"}) d.write(name, "mine");
    const std::map<std::string, std::string> before = contents_of(d);
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"render", "-o", "mine.png"},
             {"render", "-o", "other.exr", "-o", "mine.png"},
             {"compare", "-o", "mine.png", "--reflection", "phong,lambert"},
             {"diff", "texture.ppm", "sky.ppm", "-o", "mine.ppm"},
             {"diff", "texture.ppm", "sky.ppm", "--decoded", "mine.ppm"},
             {"plot", "reflection/phong", "-o", "mine.svg"},
             {"exercise", "new", "reflection/phong", "--blank", "reflect", "-o", "mine.html"}}) {
        std::vector<std::string> all = words;
        all.emplace_back("--no-clobber");
        const CommandResult result = d.run_words(all);
        INFO(words[0] << ": " << result.err);
        CHECK(result.exit_code != 0);
        CHECK(changes_in(d, before) == "");
    }
}

TEST_CASE("import keeps existing pictures unless they are the same or --force is given") {
    const Folder d;
    const std::string image =
        "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/pLvAAAAAElFTkSuQmCC";
    d.write("m.gltf",
            R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
    "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
    "textures": [{"source": 0}], "images": [{"uri": "data:image/png;base64,)" +
                image + R"("}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
                  {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
    "buffers": [{"byteLength": 60, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/"}]})");
    succeeded(d.run("import m.gltf"));
    REQUIRE(d.has("m_textures"));
    const fs::path texture = *fs::directory_iterator(d / "m_textures");
    const std::string content = read_file(texture);
    fs::remove(d / "m.toml");
    expect(d.run("import m.gltf"), 0);
    fs::remove(d / "m.toml");
    write_file(texture, "mine");
    expect(d.run("import m.gltf"), 1, {"already exists; --force replaces it"});
    CHECK(read_file(texture) == "mine");
    CHECK_FALSE(d.has("m.toml"));
    expect(d.run("import m.gltf --force"), 0);
    CHECK(read_file(texture) == content);
}

TEST_CASE("a missing folder is reported before any work is done") {
    const Folder d = folder_with_scene();
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"render", "-o", "gone/a.png"},
             {"compare", "-o", "gone/a.png", "--reflection", "phong,lambert"},
             {"plot", "reflection/phong", "-o", "gone/a.svg"},
             {"import", "model.obj", "-o", "gone/a.toml"},
             {"new", "gone/a.toml"}})
        expect(d.run_words(words), 1, {"cannot be written: there is no folder 'gone'"});
    CHECK_FALSE(d.has("gone"));
}

TEST_CASE("if one of the terms cannot be written, neither the picture nor any other term is") {
    const Folder d;
    fs::create_directory(d / "a.specular.png");
    expect(d.run("render -o a.png --terms diffuse,specular"), 1, {"is a directory"});
    CHECK(std::distance(fs::directory_iterator(d), {}) == 1);
    fs::remove(d / "a.specular.png");
    d.write("a.png", "old");
    expect(d.run("render -o a.png --terms diffuse,specular"), 0);
    CHECK(std::distance(fs::directory_iterator(d), {}) == 3);
    CHECK(d.read("a.png") != "old");
}

TEST_CASE("a file that replaces another keeps the execute permissions, but not set-user-ID") {
    const Folder d;
    const fs::path file = d.write("a.png", "old");
    fs::permissions(file, fs::perms::owner_all | fs::perms::group_exec | fs::perms::set_uid |
                              fs::perms::set_gid | fs::perms::sticky_bit);
    succeeded(d.run("render -o a.png"));
    CHECK(fs::status(file).permissions() == (fs::perms::owner_all | fs::perms::group_exec));
}

TEST_CASE("a file in CANDELA_PLUGIN_PATH is reported") {
    const Folder d({{"file", ""}});
    const auto with = [&](const std::string& path) {
        return run_candela({"list"}, {.environment = {{"CANDELA_PLUGIN_PATH", path}}, .directory = d});
    };
    expect(with((d / "file").string()), 1, {"CANDELA_PLUGIN_PATH names '", "which is not a folder"});
    expect(with(d.path().string() + ":" + (d / "file").string()), 1, {"which is not a folder"});
    CHECK(with(d.path().string() + "::" + (d / "gone").string()).exit_code == 0);
}

TEST_CASE("a page or a diagram does not overwrite a scene, whose extension differs") {
    const Folder d;
    succeeded(d.run("new"));
    const std::map<std::string, std::string> before = contents_of(d);
    expect(d.run("exercise new phong --blank reflect -o scene.toml"), 2,
           {"'scene.toml' is not the name of a page; expected one that ends in .html"});
    expect(d.run("plot reflection/phong -o scene.toml"), 2, {"neither .svg nor .csv"});
    expect(d.run("render -o scene.toml"), 2, {"has a format that no image plugin writes"});
    CHECK(changes_in(d, before) == "");
}
