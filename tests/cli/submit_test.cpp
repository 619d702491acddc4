// candela submit and candela status: many processes make the same files as one, however they end.
#include <signal.h>
#include <sys/stat.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "support/box_scene.h"
#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/text.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

std::string scene_text() {
    return box_scene(33, 21) + R"([animation]
frames = 12
fps = 12
[animation.orbit]
)";
}

constexpr const char* k_job = "frames/.candela/jobs/%04d.png";

Folder with_scene() { return {{"scene.toml", scene_text()}}; }

CommandResult candela(const Folder& directory, const std::vector<std::string>& words,
                      const std::string& path = "") {
    CommandSetup setup{.directory = directory};
    if (!path.empty()) setup.environment.emplace_back("PATH", path);
    return run_candela(words, setup);
}

json status_of(const Folder& directory) {
    const CommandResult result = succeeded(candela(directory, {"status", "frames", "--json"}));
    return json::parse(result.out).at(0);
}

std::string shell(const std::string& command, const fs::path& directory,
                  std::vector<std::pair<std::string, std::string>> environment = {}) {
    const CommandResult result = run_program({"/bin/sh", "-c", command},
                                             {.environment = std::move(environment), .directory = directory});
    INFO(command << '\n' << result.err);
    CHECK(result.exit_code == 0);
    return result.out;
}

/// The files that one process makes of the same scene, frame by frame.
void check_frames(const Folder& directory, int count = 12) {
    REQUIRE(candela(directory, {"animate", "scene.toml", "-o", "alone/%04d.png"}).exit_code == 0);
    for (int i = 0; i < count; ++i) {
        const std::string name = (i < 10 ? "000" : "00") + std::to_string(i) + ".png";
        INFO(name);
        CHECK(read_file(directory / "frames" / name) == read_file(directory / "alone" / name));
    }
}

/// A folder with an `sbatch` that records its arguments and input, and numbers jobs from 41 on.
std::string with_queue(const Folder& directory) {
    const fs::path folder = directory / "bin";
    fs::create_directories(folder);
    write_file(folder / "sbatch", R"(#!/bin/sh
number=$((41 + $(cat submitted 2>/dev/null | wc -l)))
echo "$*" >>submitted
for last; do :; done
cp "$last" "job-$number.sh"
echo "$number;a-cluster"
)");
    ::chmod((folder / "sbatch").c_str(), 0755);
    return folder.string() + ":/usr/bin:/bin";
}

template <class Condition>
void wait_until(const Condition& is_so) {
    for (int i = 0; i < 6000 && !is_so(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    REQUIRE(is_so());
}

/// Names that exist only while a file is being written.
std::size_t unfinished_in(const Folder& folder) {
    return static_cast<std::size_t>(
        std::count_if(fs::recursive_directory_iterator(folder), fs::recursive_directory_iterator(),
                      [](const fs::directory_entry& entry) {
                          return entry.path().filename().string().starts_with(".candela-");
                      }));
}

}  // namespace

TEST_CASE("submit on this machine makes the same frames as animate, and status reports them") {
    const Folder directory = with_scene();
    const CommandResult result = candela(directory, {"submit", "scene.toml", "--jobs", "3", "--chunk", "5"});
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    CHECK(holds(result.err, "3 tasks"));
    check_frames(directory);
    const json status = status_of(directory);
    CHECK(status["done"] == 3);
    CHECK(status["tasks"][2]["name"] == "10..11");
    CHECK(status["tasks"][2]["files_done"] == 2);
    CHECK(holds(candela(directory, {"status", "frames"}).out, "12 of 12 files done, in 3 tasks"));
    // Again: nothing is left to do.
    CHECK(holds(candela(directory, {"submit", "scene.toml", "--chunk", "5"}).err, "3 of them already done"));
}

TEST_CASE("a failed task does not affect the others, says why, and is finished by the same command") {
    const Folder directory = with_scene();
    fs::create_directories(directory / "frames/0007.png");
    CommandResult result = expect(candela(directory, {"submit", "scene.toml", "--chunk", "4", "--jobs", "2"}),
                                  1, {"task 4..7: ", "1 of 3 tasks failed"});
    json status = status_of(directory);
    CHECK(status["done"] == 2);
    CHECK(status["failed"] == 1);
    CHECK(status["tasks"][1]["files_done"] == 3);
    CHECK(holds(status["tasks"][1]["why"], "frames/0007.png"));
    CHECK(holds(candela(directory, {"status", "frames"}).out, "frames/0007.png"));

    fs::remove(directory / "frames/0007.png");
    result = candela(directory, {"submit", "scene.toml", "--chunk", "4", "--jobs", "2"});
    INFO(result.err);
    CHECK(result.exit_code == 0);
    status = status_of(directory);
    CHECK(status["done"] == 3);
    CHECK_FALSE(status["tasks"][1].contains("why"));
    check_frames(directory);
}

TEST_CASE("the command lines printed by submit do the job in any order, from any folder") {
    const Folder directory = with_scene();
    const CommandResult result = succeeded(
        candela(directory, {"submit", "scene.toml", "--engine", "print", "--chunk", "5", "--step", "2"}));
    std::vector<std::string> lines = lines_of(result.out);
    REQUIRE(lines.size() == 2);
    CHECK(read_file(directory / k_job / "tasks") == result.out);
    CHECK(status_of(directory)["waiting"] == 2);
    std::ranges::reverse(lines);
    for (const std::string& line : lines) shell(line, "/");
    CHECK(status_of(directory)["done"] == 2);
    CHECK(directory.has("frames/0010.png"));
    CHECK_FALSE(directory.has("frames/0001.png"));
}

TEST_CASE("Slurm gets an array of tasks and a last task after it, whose scripts do the job") {
    const Folder directory = with_scene();
    const std::string queue = with_queue(directory);
    const std::vector<std::string> submit = {"submit",
                                             "scene.toml",
                                             "--engine",
                                             "slurm",
                                             "--chunk",
                                             "5",
                                             "--threads",
                                             "3",
                                             "--slurm=--partition=render",
                                             "-o",
                                             "frames/%04d.png"};
    const CommandResult shown = [&] {
        auto words = submit;
        words.emplace_back("--dry-run");
        return candela(directory, words, queue);
    }();
    CHECK(shown.exit_code == 0);
    CHECK_FALSE(directory.has("submitted"));
    CHECK_FALSE(directory.has("frames"));

    const CommandResult result = succeeded(candela(directory, submit, queue));
    CHECK(result.out == "41\n");
    const std::string script = directory.read("job-41.sh");
    CHECK(holds(shown.out, script));
    CHECK(holds(script, "\n#SBATCH --array=1-3\n"));
    CHECK(holds(script, "\n#SBATCH --cpus-per-task=3\n"));
    CHECK(holds(script, "\n#SBATCH --partition=render\n"));
    CHECK(status_of(directory)["number"] == "41");
    for (const char* const task : {"3", "1", "2"})
        shell("sh " + (directory / "job-41.sh").string(), "/", {{"SLURM_ARRAY_TASK_ID", task}});
    CHECK(status_of(directory)["done"] == 3);
    check_frames(directory);

    // Only the unfinished tasks are submitted again.
    fs::remove(directory / "frames/0006.png");
    REQUIRE(candela(directory, submit, queue).exit_code == 0);
    CHECK(holds(directory.read("job-42.sh"), "\n#SBATCH --array=2\n"));
}

TEST_CASE("the film is the last task, which Slurm starts once all others have succeeded") {
    const Folder directory = with_scene();
    const std::string queue = with_queue(directory);
    directory.write("bin/ffmpeg", "#!/bin/sh\nfor last; do :; done\necho film >\"$last\"\n");
    ::chmod((directory / "bin/ffmpeg").c_str(), 0755);
    const std::vector<std::string> submit = {"submit", "scene.toml",      "--engine", "slurm",
                                             "-o",     "frames/%04d.png", "-o",       "film.mp4"};
    const CommandResult result = succeeded(candela(directory, submit, queue));
    CHECK(result.out == "41\n42\n");
    CHECK(holds(directory.read("submitted"), "--dependency=afterok:41 --kill-on-invalid-dep=yes"));
    CHECK(status_of(directory)["last"]["state"] == "waiting");
    shell("sh job-42.sh", directory, {{"PATH", queue}});
    CHECK(directory.read("film.mp4") == "film\n");
    CHECK(status_of(directory)["last"]["state"] == "done");
}

TEST_CASE("a task is running while its process exists, and failed if that has ended without a report") {
    const Folder directory = with_scene();
    REQUIRE(candela(directory, {"submit", "scene.toml", "--engine", "print", "--chunk", "12"}).exit_code ==
            0);
    RunningProgram task({CANDELA_TEST_COMMAND, "--task", directory / k_job / "0..11.json", "animate",
                         "scene.toml", "--width", "3000", "--height", "3000"},
                        {.directory = directory});
    wait_until([&] { return fs::exists(directory / k_job / "0..11.json"); });
    task.send(SIGSTOP);
    json status = status_of(directory);
    CHECK(status["running"] == 1);
    CHECK(holds(candela(directory, {"status", "frames"}).out, "0..11, 0 of 12 done, on "));
    task.send(SIGKILL);
    CHECK(task.wait().exit_code == 128 + SIGKILL);
    status = status_of(directory);
    CHECK(status["failed"] == 1);
    CHECK(holds(status["tasks"][0]["why"], "ended without a report"));
    // The queue's log says more.
    write_file(directory / k_job / "1.log", "slurmstepd: error: Detected 1 oom_kill event\n");
    CHECK(holds(status_of(directory)["tasks"][0]["why"], "oom_kill"));
}

TEST_CASE("frames made from other inputs than were submitted are not counted as done") {
    const Folder directory = with_scene();
    REQUIRE(candela(directory, {"submit", "scene.toml"}).exit_code == 0);
    std::string scene = scene_text();
    scene.replace(scene.find("9.0"), 3, "8.0");
    directory.write("scene.toml", scene);
    REQUIRE(candela(directory, {"animate", "scene.toml", "--frames", "3..4"}).exit_code == 0);
    const json status = status_of(directory);
    CHECK(status["done"] == 1);
    CHECK(status["tasks"][0]["files_done"] == 8);
    CHECK(status["tasks"][0]["files_made_from_something_else"] == 2);
    CHECK(holds(candela(directory, {"status", "frames"}).out, "2 files made from other inputs"));
}

TEST_CASE("twenty kills at any moment leave a job that the same command completes") {
    const Folder directory = with_scene();
    std::minstd_rand random(19);
    const std::vector<std::string> submit = {
        CANDELA_TEST_COMMAND, "submit", "scene.toml", "--jobs", "2", "--chunk", "2"};
    for (int i = 0; i < 20; ++i) {
        // Its tasks are in its process group, and outlive it every other time.
        CommandSetup setup{.directory = directory};
        setup.prepare = [] { ::setpgid(0, 0); };
        RunningProgram job(submit, setup);
        std::this_thread::sleep_for(std::chrono::milliseconds(random() % 120));
        if (i % 2 == 0) {
            ::kill(-job.pid(), SIGKILL);
        } else {
            job.send(SIGKILL);
        }
        static_cast<void>(job.wait());
        if (fs::exists(directory / k_job / "plan.json")) CHECK(status_of(directory)["tasks"].size() == 6);
    }
    expect(run_program(submit, {.directory = directory}), 0);
    CHECK(status_of(directory)["done"] == 6);
    check_frames(directory);
    CHECK(unfinished_in(directory) == 0);
}

TEST_CASE("submit, told to end, ends its tasks") {
    const Folder directory = with_scene();
    RunningProgram job({CANDELA_TEST_COMMAND, "submit", "scene.toml", "--width", "4000", "--height", "4000",
                        "--jobs", "2", "--chunk", "6"},
                       {.directory = directory});
    const fs::path journal = directory / k_job / "6..11.json";
    wait_until([&] { return fs::exists(journal); });
    const int task = json::parse(read_file(journal))["pid"];
    job.send(SIGTERM);
    CHECK(job.wait().exit_code == 128 + SIGTERM);
    CHECK(::kill(task, 0) != 0);
    CHECK(status_of(directory)["running"] == 0);
    CHECK(unfinished_in(directory) == 0);
}

TEST_CASE("submit and status explain what they cannot do") {
    const Folder directory = with_scene();
    const auto refused = [&](const std::vector<std::string>& words, int code, const std::string& part) {
        expect(candela(directory, words, "/nowhere"), code, {part});
    };
    refused({"submit"}, 2, "needs a scene file");
    refused({"submit", "scene.toml", "--engine", "slum"}, 2, "did you mean 'slurm'?");
    refused({"submit", "scene.toml", "--engine", "print", "--jobs", "2"}, 2,
            "--jobs applies only to --engine local");
    refused({"submit", "scene.toml", "--slurm=--exclusive"}, 2, "--slurm applies only to --engine slurm");
    refused({"submit", "scene.toml", "--chunk", "0"}, 2, "--chunk is 0");
    refused({"submit", "scene.toml", "-o", "a.png"}, 2, "a%04d.png");
    refused({"submit", "-", "--engine", "print"}, 2, "write it to a file");
    refused({"submit", "scene.toml", "--engine", "slurm"}, 1, "apt install slurm-client");
    refused({"submit", "scene.toml", "--set", "object.box.position=[99, 0, 0]"}, 3,
            "object 'box' is not wholly inside the room");
    refused({"status", "nowhere"}, 1, "no job was submitted for 'nowhere'");
    directory.write("frames/.candela/jobs/x/plan.json", "{}");
    refused({"status", "frames"}, 1, "is not a valid job plan");
}
