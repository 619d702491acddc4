// candela edit: the text that it writes, and its messages when it writes nothing.
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch_test_macros.hpp>
#include <csignal>
#include <filesystem>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

const std::string k_scene =
    "# Mine.\nversion = 1\n[observer]\nposition = [0, 0, 4] # metres\nlook_at = [0, 0, 0]\n"
    "[shading]\nmodel = \"phong\"\n[reflection]\nmodel = \"phong\"\n"
    "[[light]]\nname = \"key\"\ntype = \"point\"\nposition = [1, 1, 3]\n"
    "[[object]]\ntype = \"sphere\"\nradius = 0.5\n";

struct Edited {
    CommandResult result;
    std::string text;
};

Edited edit(const std::vector<std::string>& options) {
    const Folder folder;
    const fs::path file = folder.write("scene.toml", k_scene);
    Edited edited{folder.run("edit scene.toml", options), {}};
    edited.text = read_file(file);
    // Neither a draft nor any other file remains next to the scene.
    CHECK(std::distance(fs::directory_iterator(folder), fs::directory_iterator()) == 1);
    return edited;
}

/// Lets a traced program run to its first call of fsync, does something, and resumes it; false if it ends
/// before that.
bool act_before_sync(pid_t program, const std::function<void()>& act) {
    int status = 0;
    if (::waitpid(program, &status, 0) != program || !WIFSTOPPED(status)) return false;
    if (::ptrace(PTRACE_SETOPTIONS, program, nullptr, PTRACE_O_TRACESYSGOOD) != 0) return false;
    for (;;) {
        if (::ptrace(PTRACE_SYSCALL, program, nullptr, nullptr) != 0) return false;
        if (::waitpid(program, &status, 0) != program || !WIFSTOPPED(status)) return false;
        __ptrace_syscall_info call{};
        if (::ptrace(PTRACE_GET_SYSCALL_INFO, program, sizeof call, &call) <= 0) return false;
        if (call.op != PTRACE_SYSCALL_INFO_ENTRY || call.entry.nr != SYS_fsync) continue;
        act();
        return ::ptrace(PTRACE_DETACH, program, nullptr, nullptr) == 0;
    }
}

}  // namespace

TEST_CASE("candela edit does not overwrite changes saved since it read the file") {
    const Folder folder;
    const fs::path file = folder.write("scene.toml", k_scene);
    const std::string theirs = k_scene + "# Theirs.\n";
    CommandSetup setup{.directory = folder};
    setup.prepare = [] {
        if (::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) ::_exit(125);
    };
    RunningProgram program({CANDELA_TEST_COMMAND, "edit", "scene.toml", "--change", "image.width=9"}, setup);
    if (!act_before_sync(program.pid(), [&] { write_file(file, theirs); }))
        SKIP("no program can be traced here");
    const CommandResult result = program.wait();
    INFO(result.err);
    CHECK(result.exit_code == 1);
    CHECK(holds(result.err, "scene.toml' was saved by another program meanwhile; not overwriting it"));
    CHECK(read_file(file) == theirs);
    CHECK(std::distance(fs::directory_iterator(folder), fs::directory_iterator()) == 1);
}

TEST_CASE("candela edit writes values into the file and reports its name") {
    const Edited edited = edit({"--change", "light.key.intensity=0.5", "--change=observer.position=[0,1,4]"});
    CHECK(edited.result.exit_code == 0);
    CHECK(edited.result.err == "scene.toml: changed\n");
    CHECK(edited.text ==
          "# Mine.\nversion = 1\n[observer]\nposition = [0, 1, 4] # metres\nlook_at = [0, 0, 0]\n"
          "[shading]\nmodel = \"phong\"\n[reflection]\nmodel = \"phong\"\n"
          "[[light]]\nname = \"key\"\ntype = \"point\"\nposition = [1, 1, 3]\nintensity = 0.5\n"
          "[[object]]\ntype = \"sphere\"\nradius = 0.5\n");
}

TEST_CASE("candela edit writes nothing and says why if the scene would have errors") {
    struct Wrong {
        std::vector<std::string> options;
        int exit_code;
        const char* message;
    };
    for (const Wrong& wrong : {
             Wrong{{"--change", "light.kye.intensity=1"}, 3, "no light is called 'kye'"},
             Wrong{{"--change", "light.key.intensity=-1"}, 3, "intensity"},
             Wrong{{"--change", "shading.model=gourad"}, 3, "gouraud"},
             // Only the triangles show this error.
             Wrong{{"--change", "light.key.position=[0,0,0]"}, 3, "is inside object"},
             Wrong{{"--change", "width"}, 2, "has no '='"},
             Wrong{{}, 2, "nothing to change"},
             Wrong{{"--change", "light.key.intensity=2", "--set", "light.key.intensity=3"},
                   2,
                   "takes precedence"},
         }) {
        const Edited edited = edit(wrong.options);
        INFO(edited.result.err);
        CHECK(edited.result.exit_code == wrong.exit_code);
        CHECK(holds(edited.result.err, wrong.message));
        CHECK(edited.result.out.empty());
        CHECK(edited.text == k_scene);
    }
}

TEST_CASE("candela edit needs a file to write into") {
    expect(run_candela({"edit", "--change", "image.width=9"}), 2);
    expect(run_candela({"edit", "-", "--change", "image.width=9"}, {.input = k_scene}), 2, {"pipe"});
    CHECK(run_candela({"edit", "missing.toml", "--change", "image.width=9"}).exit_code != 0);
}

TEST_CASE("candela edit changes the first line of a file with a byte order mark, and keeps the mark") {
    const Folder folder;
    const std::string mark = "\xef\xbb\xbf";
    const fs::path file =
        folder.write("scene.toml", mark + "image = { width = 100, height = 50 }\n" + k_scene);
    expect(folder.run("edit scene.toml --change image.width=200 --change image.samples=4"), 0);
    CHECK(read_file(file) == mark + "image = { width = 200, height = 50, samples = 4 }\n" + k_scene);
}

TEST_CASE("any number of objects and changes is edited in one go") {
    const Folder folder;
    std::string scene = k_scene;
    std::vector<std::string> words{"edit", "scene.toml"};
    for (int i = 0; i < 300; ++i) {
        const std::string name = "s" + std::to_string(i);
        scene += "[[object]]\nname = \"" + name + "\"\ntype = \"sphere\"\nradius = 0.01\nposition = [" +
                 std::to_string(-4 + 0.025 * i) + ", 2, 0]\n";
        words.push_back("--change=object." + name + ".color=[" + std::to_string(i % 250) + ",9,9]");
        words.push_back("--change=object." + name + ".radius=0.011");
    }
    const fs::path file = folder.write("scene.toml", scene);
    expect(folder.run_words(words), 0);
    const std::string text = read_file(file);
    CHECK(holds(text,
                "name = \"s7\"\ntype = \"sphere\"\nradius = 0.011\nposition = [-3.825000, 2, 0]\ncolor = [7, "
                "9, 9]\n"));
    CHECK(holds(text, "color = [49, 9, 9]\n"));
}

TEST_CASE("candela edit writes the path of a file relative to the scene's file, wherever it is run") {
    const Folder folder;
    folder.write("wood.ppm", "P6\n1 1\n255\nabc");
    folder.write("matt.kernel",
                 "KERNEL Reflected matt_reflect(Surface s, vec3 to_light) {\n    return Reflected(s.color * "
                 "max(dot(s.normal, to_light), 0.0f), vec3(0.0f));\n}\n");
    const fs::path file = folder.write("below/scene.toml", k_scene);
    const Folder::Environment cache{{"XDG_CACHE_HOME", (folder / "cache").string()}};
    expect(folder.run("edit below/scene.toml --change reflection.model=matt.kernel --change "
                      "object.0.color={texture=\"wood.ppm\"}",
                      {}, cache),
           0);
    const std::string text = read_file(file);
    CHECK(holds(text, "model = \"../matt.kernel\"\n"));
    CHECK(holds(text, "texture = \"../wood.ppm\""));
    // A name that stands for a file in both folders means the same one as before.
    fs::copy_file(folder / "matt.kernel", folder / "below/matt.kernel");
    expect(folder.run("edit below/scene.toml --change reflection.model=matt.kernel", {}, cache), 0);
    CHECK(read_file(file) == text);
    expect(folder.run("edit below/scene.toml --change reflection.model=below/matt.kernel", {}, cache), 0);
    CHECK(holds(read_file(file), "model = \"matt.kernel\"\n"));
}
