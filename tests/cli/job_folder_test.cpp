// Job folders filled by an attacker: links, pipes, endless files, and forged journals.
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "sandbox/temporary_folder.h"
#include "support/box_scene.h"
#include "support/command.h"
#include "support/expect.h"
#include "support/text.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

const fs::path k_job = "frames/.candela/jobs/%04d.png";
const Words k_submit = {"submit", "scene.toml", "-o", "frames/%04d.png", "--chunk", "2", "--jobs", "1"};

/// A folder with a scene of two frames, and another folder that no command may touch.
struct JobWorkspace {
    JobWorkspace() : directory(scratch_directory()), victims(directory / "victims") {
        write_file(directory / "scene.toml", box_scene(20, 12) + "[animation]\nframes = 2\nfps = 12\n");
        write_file(victim(), k_content);
    }

    CommandResult candela(const Words& words, const std::string& path = "") const {
        CommandSetup setup{.directory = directory};
        if (!path.empty()) setup.environment.emplace_back("PATH", path);
        return run_candela(words, setup);
    }
    fs::path victim() const { return victims / "victim"; }
    void check_victims() const {
        CHECK(read_file(victim()) == k_content);
        CHECK(static_cast<int>(std::distance(fs::directory_iterator(victims), fs::directory_iterator())) ==
              1);
    }
    /// A link, or another name, in the place of a file of Candela's.
    void put_link(const fs::path& at, const fs::path& to) const {
        fs::create_directories((directory / at).parent_path());
        fs::create_symlink(to, directory / at);
    }

    static constexpr const char* k_content = "nobody may touch this\n";
    fs::path directory, victims;
};

void put_pipe(const fs::path& at) {
    fs::create_directories(at.parent_path());
    REQUIRE(::mkfifo(at.c_str(), 0600) == 0);
}

/// A file too large for any memory that takes no space on the disk.
void put_endless(const fs::path& at) {
    write_file(at, "");
    fs::resize_file(at, std::uintmax_t{1} << 42);
}

}  // namespace

TEST_CASE("links in place of a job's files and frames are replaced, never followed") {
    const std::vector<fs::path> names = {
        k_job / "plan.json", k_job / "tasks",   k_job / "0..1.json", k_job / "finish.json",
        k_job / "1.log",     "frames/0000.png", "frames/0001.png",   "frames/.candela/0000.png"};
    for (const bool is_dangling : {false, true}) {
        const JobWorkspace place;
        for (const fs::path& name : names)
            place.put_link(name, is_dangling ? place.victims / "new" : place.victim());
        const CommandResult result = place.candela(k_submit);
        INFO(result.err);
        CHECK(result.exit_code == 0);
        place.check_victims();
        for (const char* const name : {"frames/0000.png", "frames/0001.png", "frames/.candela/0000.png"})
            CHECK(fs::is_regular_file(fs::symlink_status(place.directory / name)));
        CHECK(holds(place.candela({"status", "frames"}).out, "2 of 2 files done"));
    }
}

TEST_CASE(
    "hard links in place of a job's files and frames are removed, and their other names are untouched") {
    const JobWorkspace place;
    for (const fs::path& name : {k_job / "plan.json", k_job / "0..1.json", fs::path("frames/0000.png"),
                                 fs::path("frames/.candela/0000.png")}) {
        fs::create_directories((place.directory / name).parent_path());
        fs::create_hard_link(place.victim(), place.directory / name);
    }
    CHECK(place.candela(k_submit).exit_code == 0);
    place.check_victims();
}

TEST_CASE("links in place of Slurm's scripts are replaced, never followed") {
    const JobWorkspace place;
    for (const char* const name : {"tasks", "tasks.sh", "finish.sh"})
        place.put_link(k_job / name, place.victim());
    write_file(place.directory / "bin/sbatch", "#!/bin/sh\necho 1\n");
    write_file(place.directory / "bin/ffmpeg", "#!/bin/sh\n");
    for (const char* const name : {"bin/sbatch", "bin/ffmpeg"})
        fs::permissions(place.directory / name, fs::perms::owner_all);
    const CommandResult result = place.candela(
        {"submit", "scene.toml", "-o", "frames/%04d.png", "-o", "film.mp4", "--engine", "slurm"},
        (place.directory / "bin").string() + ":/usr/bin:/bin");
    INFO(result.err);
    CHECK(result.exit_code == 0);
    place.check_victims();
}

TEST_CASE("a link in place of a frame is replaced, even if its target is the right picture") {
    const JobWorkspace place;
    REQUIRE(place.candela({"animate", "scene.toml"}).exit_code == 0);
    const fs::path frame = place.directory / "frames/0001.png";
    fs::rename(frame, place.directory / "elsewhere.png");
    place.put_link("frames/0001.png", place.directory / "elsewhere.png");
    REQUIRE(place.candela({"animate", "scene.toml"}).exit_code == 0);
    CHECK(fs::is_regular_file(fs::symlink_status(frame)));
}

TEST_CASE("links in place of a picture's parts are replaced, never followed") {
    for (const bool is_dangling : {false, true}) {
        const JobWorkspace place;
        const std::vector<fs::path> names = {"p.tif.parts/picture.json", "p.tif.parts/1-of-2.pixels",
                                             "p.tif.parts/.candela/1-of-2.pixels", ".candela/p.tif"};
        for (const fs::path& name : names)
            place.put_link(name, is_dangling ? place.victims / "new" : place.victim());
        for (const char* const part : {"1/2", "2/2"}) {
            const CommandResult result =
                place.candela({"render", "scene.toml", "-o", "p.tif", "--part", part});
            INFO(result.err);
            CHECK(result.exit_code == 0);
        }
        CHECK(place.candela({"assemble", "p.tif"}).exit_code == 0);
        place.check_victims();
    }
}

TEST_CASE("links in place of a job's or a picture's folders are refused by name") {
    for (const char* const name :
         {"frames/.candela", "frames/.candela/jobs", "frames/.candela/jobs/%04d.png"}) {
        const JobWorkspace place;
        place.put_link(name, place.victims);
        expect(place.candela(k_submit), 1,
               {"'" + std::string(name) + "' cannot be created: a link or a file is in its place"});
        place.check_victims();
    }
    for (const char* const name : {"p.tif.parts", "p.tif.parts/.candela"}) {
        const JobWorkspace place;
        place.put_link(name, place.victims);
        expect(place.candela({"render", "scene.toml", "-o", "p.tif", "--part", "1/2"}), 1,
               {"'" + std::string(name) + "' cannot be created"});
        place.check_victims();
    }
    const JobWorkspace place;
    place.put_link("frames/.candela", place.victims);
    expect(place.candela({"animate", "scene.toml"}), 1, {"'frames/.candela' cannot be created"});
    place.check_victims();
}

TEST_CASE("pipes in place of a job's files are refused without waiting for them") {
    const std::vector<fs::path> names = {k_job / "plan.json", "frames/0001.png", "frames/.candela/0000.png"};
    for (const fs::path& name : names) {
        const JobWorkspace place;
        put_pipe(place.directory / name);
        expect(place.candela(k_submit), 1, {"is a pipe, a socket or a device"});
        CHECK(fs::is_fifo(place.directory / name));
    }
    const JobWorkspace place;
    REQUIRE(place.candela(k_submit).exit_code == 0);
    fs::remove(place.directory / "frames/0000.png");
    for (const char* const name : {"0..1.json", "1.log"}) {
        fs::remove(place.directory / k_job / name);
        put_pipe(place.directory / k_job / name);
    }
    CHECK(holds(place.candela({"status", "frames"}).out, "waiting  1 task"));
    fs::remove(place.directory / k_job / "plan.json");
    put_pipe(place.directory / k_job / "plan.json");
    expect(place.candela({"status", "frames"}), 1, {"plan.json' cannot be read"});
}

TEST_CASE("endless files in a job's folder take neither memory nor time") {
    const JobWorkspace place;
    REQUIRE(place.candela(k_submit).exit_code == 0);
    const fs::path job = place.directory / k_job;
    fs::remove(place.directory / "frames/0000.png");
    put_endless(place.directory / "frames/.candela/0001.png");
    put_endless(job / "0..1.json");
    CHECK(holds(place.candela({"status", "frames"}).out, "waiting  1 task"));
    write_file(job / "0..1.json", R"({"state": "running", "host": "h", "pid": 1, "machine": "another"})");
    put_endless(job / "1.log");
    REQUIRE(::truncate((job / "1.log").c_str(), off_t{1} << 42) == 0);
    const timespec long_ago[2] = {{.tv_sec = 1000, .tv_nsec = 0}, {.tv_sec = 1000, .tv_nsec = 0}};
    REQUIRE(::utimensat(AT_FDCWD, (job / "0..1.json").c_str(), long_ago, 0) == 0);
    CHECK(holds(place.candela({"status", "frames"}).out, "failed   1 task"));
    put_endless(job / "plan.json");
    expect(place.candela({"status", "frames"}), 1, {"at most 64 MB"});

    REQUIRE(place.candela({"render", "scene.toml", "-o", "p.tif", "--part", "1/1"}).exit_code == 0);
    write_file(place.directory / "p.tif.parts/picture.json",
               R"({"version": 1, "width": 1, "height": 2147483647, "pixels": "byte", "srgb": true,)"
               R"( "parts": 2147483647, "inputs": ""})");
    expect(place.candela({"assemble", "p.tif"}), 1, {"does not describe a picture"});
    put_endless(place.directory / "p.tif.parts/picture.json");
    CHECK(place.candela({"assemble", "p.tif"}).exit_code == 1);
}

TEST_CASE("a folder in place of a task's journal ends the job with an error, not a signal") {
    const JobWorkspace place;
    fs::create_directories(place.directory / k_job / "0..1.json");
    write_file(place.directory / k_job / "0..1.json" / "file", "");  // an empty folder is replaced
    const CommandResult result = place.candela(k_submit);
    expect(result, 1, {"is not the journal of a task"});
    CHECK(holds(result.err, "0..1.json' is a directory"));
    CHECK(holds(result.err, "1 of 1 tasks failed"));
}

TEST_CASE("a journal's claim that its task runs is believed only if its process can exist now") {
    const JobWorkspace place;
    REQUIRE(place.candela({"submit", "scene.toml", "--engine", "print", "--chunk", "2"}).exit_code == 0);
    const fs::path file = place.directory / k_job / "0..1.json";
    const auto running = [&] {
        const CommandResult result = place.candela({"status", "frames", "--json"});
        INFO(result.err);
        REQUIRE(result.exit_code == 0);
        return json::parse(result.out).at(0).at("running") == 1;
    };
    // For a task that runs and is stopped before it records that it is done.
    RunningProgram task({CANDELA_TEST_COMMAND, "--task", k_job / "0..1.json", "animate", "scene.toml",
                         "--width", "3000", "--height", "3000"},
                        {.directory = place.directory});
    for (int i = 0; i < 6000 && !fs::exists(file); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    task.send(SIGSTOP);
    const json honest = json::parse(read_file(file));
    CHECK(running());

    const auto with = [&](const char* key, const json& value) {
        json entry = honest;
        entry[key] = value;
        write_file(file, entry.dump());
        return running();
    };
    CHECK(with("pid", honest["pid"]));
    for (const json& pid :
         {json(0), json(-1), json(1.5), json("1"), json(nullptr), json(std::int64_t{1} << 40),
          json((std::int64_t{1} << 32) + honest["pid"].get<std::int64_t>())})
        CHECK_FALSE(with("pid", pid));
    CHECK_FALSE(with("pid", ::getpid()));  // exists, but was started at another time
    CHECK_FALSE(with("state", "sleeping"));
    CHECK_FALSE(with("began_seconds", honest["began_seconds"].get<double>() + 1e6));

    for (const std::int64_t offset : {86400, 1'000'000'000}) {
        json elsewhere = honest;
        elsewhere["machine"] = "another";
        write_file(file, elsewhere.dump());
        CHECK(running());
        timespec time{};
        ::clock_gettime(CLOCK_REALTIME, &time);
        time.tv_sec += offset;
        const timespec times[2] = {time, time};
        REQUIRE(::utimensat(AT_FDCWD, file.c_str(), times, 0) == 0);
        CHECK_FALSE(running());
        CHECK(holds(place.candela({"status", "frames"}).out, "its journal has times in the future"));
    }
    task.send(SIGKILL);
    static_cast<void>(task.wait());
}

TEST_CASE("a plan whose tasks name files elsewhere is invalid") {
    const JobWorkspace place;
    REQUIRE(place.candela(k_submit).exit_code == 0);
    json plan = json::parse(read_file(place.directory / k_job / "plan.json"));
    plan["tasks"][0]["name"] = "../../../victims/victim";
    write_file(place.directory / k_job / "plan.json", plan.dump());
    expect(place.candela({"status", "frames"}), 1, {"is not a valid job plan"});
}

TEST_CASE("names that job scripts cannot hold are refused by every engine before anything is written") {
    const JobWorkspace place;
    struct Case {
        std::string folder;
        const char* reason;
    };
    for (const auto& [folder, reason] : {Case{"a\nb", "a line break"}, Case{"a\rb", "control character"},
                                         Case{"a\x1b[31mb", "control character"},
                                         Case{"a\xff"
                                              "b",
                                              "not UTF-8"}}) {
        for (const char* const engine : {"local", "print", "slurm"}) {
            expect(place.candela({"submit", "scene.toml", "-o", folder + "/%04d.png", "--engine", engine}), 2,
                   {reason});
        }
        expect(place.candela({"submit", "scene.toml", "-o", folder + "/p.png", "--parts", "2"}), 2, {reason});
        CHECK_FALSE(fs::exists(place.directory / folder));
    }
    fs::create_directories(place.directory / "x\n#SBATCH --wrap=touch");
    fs::copy(place.directory / "scene.toml", place.directory / "x\n#SBATCH --wrap=touch/scene.toml");
    expect(run_candela({"submit", "scene.toml", "--engine", "slurm", "--dry-run"},
                       {.directory = place.directory / "x\n#SBATCH --wrap=touch"}),
           2, {"a line break"});
    expect(place.candela({"submit", "scene.toml", "--engine", "slurm", "--slurm=--a\n#SBATCH --b"}), 2,
           {"a line break"});
    for (const char* const name : {"a\"b", "a\\b"}) {
        expect(place.candela({"submit", "scene.toml", "-o", std::string(name) + "/%04d.png", "--engine",
                              "slurm", "--dry-run"}),
               2, {"a quotation mark or a backslash"});
    }
    expect(place.candela({"submit", "scene.toml", "-o", "a\u202e/%04d.png", "--engine", "print"}), 2,
           {"cannot print unchanged"});
    fs::create_directories(place.directory / "b\u202e");
    fs::copy(place.directory / "scene.toml", place.directory / "b\u202e/scene.toml");
    expect(run_candela({"submit", "scene.toml", "--engine", "print"},
                       {.directory = place.directory / "b\u202e"}),
           2, {"cannot print unchanged"});
}

TEST_CASE("names that are special to a shell or sbatch are quoted in scripts and command lines") {
    const JobWorkspace place;
    for (const char* const name :
         {"$(touch t)", "`touch t`", "a'b", "; touch t", "# x", "-x", "100%", "~", "ü"}) {
        INFO(name);
        const std::string frames = std::string(name) + "/f/%%x%04d.png";
        const CommandResult result =
            place.candela({"submit", "scene.toml", "--engine", "print", "--output=" + frames});
        INFO(result.err);
        // "100%" is an invalid file name pattern.
        if (std::string(name) == "100%") {
            CHECK(result.exit_code == 2);
            continue;
        }
        REQUIRE(result.exit_code == 0);
        expect(run_program({"/bin/sh", "-c", result.out}, {.directory = place.directory / name}), 0);
        CHECK(fs::exists(place.directory / name / "f/%x0001.png"));
        CHECK_FALSE(fs::exists(place.directory / name / "t"));
        CHECK_FALSE(fs::exists(place.directory / "t"));
    }
}

TEST_CASE("submit, told to end, lets its tasks clean up while ffmpeg works") {
    const JobWorkspace place;
    const fs::path bin = place.directory / "bin", begun = place.directory / "begun";
    write_file(bin / "ffmpeg", "#!/bin/sh\nfor last; do :; done\necho part >\"$last\"\necho $$ >'" +
                                   begun.string() + ".new'\nmv '" + begun.string() + ".new' '" +
                                   begun.string() + "'\nexec sleep 1000\n");
    fs::permissions(bin / "ffmpeg", fs::perms::owner_all);
    for (const char* const verb : {"submit", "animate"}) {
        fs::remove(begun);
        RunningProgram job(
            {CANDELA_TEST_COMMAND, verb, "scene.toml", "-o", "frames/%04d.png", "-o", "films/film.mp4"},
            {.environment = {{"PATH", bin.string() + ":/usr/bin:/bin"}}, .directory = place.directory});
        for (int i = 0; i < 6000 && !fs::exists(begun); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        REQUIRE(fs::exists(begun));
        const int encoder = std::stoi(read_file(begun));
        job.send(SIGTERM);
        CHECK(job.wait().exit_code == 128 + SIGTERM);
        CHECK(fs::is_empty(place.directory / "films"));
        CHECK((::kill(encoder, 0) != 0 && errno == ESRCH));
    }
}

TEST_CASE("temporary folders are private whatever the umask, and the results are not") {
    const fs::path directory = scratch_directory();
    for (const mode_t mask : {0U, 022U, 0777U}) {
        const mode_t before = ::umask(mask);
        const TemporaryFolder folder(directory, "t-");
        ::umask(before);
        struct stat status{};
        REQUIRE(::stat(folder.path().c_str(), &status) == 0);
        CHECK((status.st_mode & 07777) == 0700);
    }
    CommandSetup setup{.directory = directory};
    setup.prepare = [] { ::umask(027); };
    succeeded(run_candela({"generate", "--target", "cpp", "-o", "program"}, setup));
    CHECK(static_cast<int>(fs::status(directory / "program").permissions()) == 0750);
}

TEST_CASE("a link in place of a folder in a report is refused, and nothing is moved", "[programs]") {
    const JobWorkspace place;
    place.put_link("report/cpp", place.victims);
    expect(place.candela({"verify", "scene.toml", "--target", "cpp", "--report", "report"}), 1,
           {"'report/cpp' cannot be created: a link or a file is in its place"});
    place.check_victims();
    CHECK_FALSE(fs::exists(place.directory / "report/index.html"));
}

TEST_CASE("status shows the other jobs of a folder with a broken one") {
    const JobWorkspace place;
    REQUIRE(place.candela(k_submit).exit_code == 0);
    write_file(place.directory / "frames/.candela/jobs/a.png/plan.json", "[]");
    put_pipe(place.directory / "frames/.candela/jobs/z.png");
    const CommandResult result = place.candela({"status", "frames"});
    CHECK(result.exit_code == 1);
    CHECK(holds(result.out, "2 of 2 files done"));
    CHECK(holds(result.err, "a.png/plan.json' is not a valid job plan"));
    CHECK(holds(result.err, "z.png/plan.json' cannot be read"));
}

TEST_CASE("a link in place of a term's picture is replaced, and one named by -o is followed") {
    const JobWorkspace place;
    place.put_link("p.diffuse.png", place.victim());
    place.put_link("p.png", place.directory / "elsewhere.png");
    const CommandResult result =
        place.candela({"render", "scene.toml", "-o", "p.png", "--terms", "diffuse", "--quiet"});
    INFO(result.err);
    CHECK(result.exit_code == 0);
    place.check_victims();
    CHECK(fs::is_regular_file(fs::symlink_status(place.directory / "p.diffuse.png")));
    CHECK(fs::is_regular_file(place.directory / "elsewhere.png"));
}

TEST_CASE("a link is followed if the user named it, and refused if its name is the default") {
    const JobWorkspace place;
    struct Case {
        Words words;
        const char* name;
    };
    for (const auto& [words, name] :
         {Case{{"render", "scene.toml"}, "candela.png"},
          Case{{"compare", "scene.toml", "--reflection", "phong,lambert"}, "comparison.png"},
          Case{{"new", "--force"}, "scene.toml"},
          Case{{"generate", "scene.toml", "--target", "cpp"}, "scene-cpp"},
          Case{{"animate", "scene.toml"}, "frames"}, Case{{"submit", "scene.toml"}, "frames"},
          Case{{"exercise", "new", "reflection/phong", "--blank", "reflect"}, "phong-reflect.html"}}) {
        const std::string scene = read_file(place.directory / "scene.toml");
        fs::remove(place.directory / name);
        const bool is_folder = fs::path(name).extension().empty();
        place.put_link(name, is_folder ? place.victims : place.victim());
        expect(place.candela(words), 1, {"the default name '" + std::string(name) + "' is a symbolic link"});
        place.check_victims();
        fs::remove(place.directory / name);
        write_file(place.directory / "scene.toml", scene);
    }
    write_file(place.directory / "there.png", "old");
    place.put_link("candela.png", place.directory / "there.png");
    REQUIRE(place.candela({"render", "scene.toml", "-o", "candela.png"}).exit_code == 0);
    CHECK(fs::is_symlink(place.directory / "candela.png"));
    CHECK(read_file(place.directory / "there.png") != "old");
}

TEST_CASE("a film whose name is that of a directory is an error that says so") {
    const JobWorkspace place;
    write_file(place.directory / "bin/ffmpeg", "#!/bin/sh\nfor last; do :; done\necho film >\"$last\"\n");
    fs::permissions(place.directory / "bin/ffmpeg", fs::perms::owner_all);
    fs::create_directories(place.directory / "film.mp4");
    expect(place.candela({"animate", "scene.toml", "-o", "film.mp4"},
                         (place.directory / "bin").string() + ":/usr/bin:/bin"),
           1, {"'film.mp4' is a directory"});
}

TEST_CASE("a picture drawn by another program is not written through a link") {
    const JobWorkspace place;
    write_file(place.directory / "bin/povray",
               "#!/bin/sh\nfor word; do case $word in +O*) echo drawn >\"${word#+O}\";; esac; done\n");
    fs::permissions(place.directory / "bin/povray", fs::perms::owner_all);
    place.put_link("program/scene.png.part", place.victim());
    place.put_link("program/scene.png", place.victim());
    const CommandResult result =
        place.candela({"generate", "scene.toml", "--target", "povray", "-o", "program", "--run"},
                      (place.directory / "bin").string() + ":/usr/bin:/bin");
    INFO(result.err);
    CHECK(result.exit_code == 0);
    CHECK(read_file(place.directory / "program/scene.png") == "drawn\n");
    place.check_victims();
}
