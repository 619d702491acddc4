// However generate, verify and plugin new end, they leave complete folders or none, and nothing else.
#include <sys/resource.h>

#include <catch2/catch_test_macros.hpp>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "support/command.h"
#include "support/expect.h"

namespace fs = std::filesystem;

namespace {

/// Every file below a folder, by its path there.
std::map<std::string, std::string> contents_of(const fs::path& folder) {
    std::map<std::string, std::string> contents;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        contents[entry.path().lexically_relative(folder).string()] =
            entry.is_directory() ? "" : read_file(entry.path());
    return contents;
}

/// The number of other entries in the parent of `folder`.
int files_beside(const fs::path& folder) {
    int count = -1;
    for (const auto& entry : fs::directory_iterator(folder.parent_path())) count += entry.exists() ? 1 : 0;
    return count;
}

/// Runs in a child as on a disk without room for large files.
CommandSetup with_room_for(rlim_t bytes) {
    CommandSetup setup;
    setup.prepare = [bytes] {
        const rlimit limit{.rlim_cur = bytes, .rlim_max = bytes};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    };
    return setup;
}

}  // namespace

TEST_CASE("generate: without room for a file, there is no new folder, and a retry writes it") {
    const fs::path scratch = scratch_directory(), directory = scratch / "deep" / "program";
    const std::vector<std::string> words{"generate", "--target", "opengl", "-o", directory.string()};
    expect(run_candela(words, with_room_for(10'000)), 1, {(directory / "scene.cpp").string()});
    CHECK(contents_of(scratch).empty());
    succeeded(run_candela(words));
    CHECK(contents_of(directory).size() == 4);
}

TEST_CASE("generate: without room for a file, an old folder keeps all of its files") {
    const fs::path scratch = scratch_directory(), directory = scratch / "program";
    const auto words = [&](const std::string& height) {
        return std::vector<std::string>{"generate",
                                        "--target",
                                        "opengl",
                                        "-o",
                                        directory.string(),
                                        "--set",
                                        "object.cube.size=0." + height};
    };
    succeeded(run_candela(words("7")));
    write_file(directory / "notes.txt", "mine");
    const auto before = contents_of(directory);
    // meshes.h fits and scene.cpp does not.
    expect(run_candela(words("8"), with_room_for(10'000)), 1);
    const bool is_untouched = contents_of(directory) == before;
    CHECK(is_untouched);
    succeeded(run_candela(words("8")));
    const auto after = contents_of(directory);
    CHECK(after.size() == before.size());
    CHECK(after.at("notes.txt") == "mine");
    const bool is_new = after.at("meshes.h") != before.at("meshes.h");
    CHECK(is_new);
}

TEST_CASE("plugin new: without room for a file, there is no folder, and a retry writes it") {
    const fs::path scratch = scratch_directory();
    for (const std::string& name : {std::string("cel"), std::string("cel-in-an-empty-folder")}) {
        const fs::path directory = scratch / name;
        if (name != "cel") fs::create_directory(directory);
        const std::vector<std::string> words{"plugin", "new", "reflection", "cel", directory.string()};
        expect(run_candela(words, with_room_for(500)), 1);
        CHECK((!fs::exists(directory) || fs::is_empty(directory)));
        succeeded(run_candela(words));
        CHECK(contents_of(directory).size() == 4);
        fs::remove_all(directory);
        CHECK(contents_of(scratch).empty());
    }
}

TEST_CASE("verify: interrupted at any moment, it leaves nothing behind", "[whole]") {
    const fs::path report = scratch_directory() / "report";
    // Not in the scratch folder, whose path is too long for a browser's sockets.
    std::string temporary = (fs::temp_directory_path() / "whole-XXXXXX").string();
    REQUIRE(::mkdtemp(temporary.data()) != nullptr);
    const CommandSetup setup{.environment = {{"TMPDIR", temporary}}};
    int interrupted = 0;
    for (int i = 0; i < 12; ++i) {
        std::vector<std::string> words{
            CANDELA_TEST_COMMAND, "verify", "--width",  "160",
            "--height",           "120",    "--target", i % 3 == 2 ? "webgl" : "cpp"};
        if (i % 2 == 1) words.insert(words.end(), {"--report", report.string()});
        RunningProgram program(words, setup);
        std::this_thread::sleep_for(std::chrono::milliseconds(60 + 220 * i));
        const int signal = std::vector<int>{SIGINT, SIGTERM, SIGHUP}[static_cast<std::size_t>(i / 2 % 3)];
        program.send(signal);
        const CommandResult result = program.wait();
        INFO("trial " << i << "\n" << result.out << result.err);
        const bool was_interrupted = result.exit_code == 128 + signal;
        CHECK((was_interrupted || result.exit_code == 0));
        interrupted += was_interrupted ? 1 : 0;
        CHECK(fs::is_empty(temporary));
        if (was_interrupted) CHECK_FALSE(fs::exists(report));
        // No compiler or browser continues and writes there again.
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        CHECK(fs::is_empty(temporary));
        fs::remove_all(report);
    }
    fs::remove_all(temporary);
    CHECK(interrupted >= 6);
}

TEST_CASE("verify: interrupted at any moment, it leaves an old report and its folder's other files intact",
          "[whole]") {
    const fs::path report = scratch_directory() / "report";
    const auto words = [&](const std::string& color) {
        return std::vector<std::string>{CANDELA_TEST_COMMAND,
                                        "verify",
                                        "--width",
                                        "160",
                                        "--height",
                                        "120",
                                        "--target",
                                        "cpp",
                                        "--set",
                                        "object.cube.color=" + color,
                                        "--report",
                                        report.string()};
    };
    succeeded(run_program(words("[40,90,235]")));
    write_file(report / "notes.txt", "mine");
    const auto before = contents_of(report);
    int interrupted = 0;
    for (int i = 0; i < 6; ++i) {
        RunningProgram program(words("[235,90,40]"));
        std::this_thread::sleep_for(std::chrono::milliseconds(60 + 200 * i));
        program.send(SIGTERM);
        const CommandResult result = program.wait();
        INFO("trial " << i << "\n" << result.out << result.err);
        if (result.exit_code == 0) break;
        REQUIRE(result.exit_code == 128 + SIGTERM);
        ++interrupted;
        const bool is_untouched = contents_of(report) == before;
        CHECK(is_untouched);
        CHECK(files_beside(report) == 0);
    }
    CHECK(interrupted >= 1);
    succeeded(run_program(words("[235,90,40]")));
    const auto after = contents_of(report);
    CHECK(after.at("notes.txt") == "mine");
    const bool is_new = after.at("reference.png") != before.at("reference.png") &&
                        after.at("cpp.png") != before.at("cpp.png");
    CHECK(is_new);
    // A program built elsewhere can be built in its present folder.
    std::vector<std::string> again = words("[235,90,40]");
    again.insert(again.end(), {"--program", (report / "cpp").string()});
    expect(run_program(again), 0);
}

TEST_CASE("verify and generate do not replace files that the scene is made from, whatever their names") {
    const fs::path folder = scratch_directory() / "folder";
    fs::create_directories(folder / "cpp");
    const auto refused = [&](const fs::path& scene, const std::vector<std::string>& words) {
        succeeded(run_candela({"new", scene.string()}));
        const std::string before = read_file(scene);
        expect(run_candela(words), 2,
               {"'" + scene.string() +
                "' is one of the files that the scene is made from; choose "
                "another folder with --"});
        const bool is_untouched = read_file(scene) == before;
        CHECK(is_untouched);
        fs::remove(scene);
    };
    const fs::path same_folder = folder / "scene.cpp", below = folder / "cpp" / "scene.cpp",
                   page = folder / "index.html";
    refused(same_folder, {"generate", same_folder.string(), "--target", "cpp", "-o", folder.string()});
    refused(below, {"verify", below.string(), "--target", "cpp", "--report", folder.string()});
    refused(page, {"verify", page.string(), "--target", "cpp", "--report", folder.string()});
}
