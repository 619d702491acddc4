// Whatever happens while a picture is written, the file in its place is complete, and no other file appears
// next to it.
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "support/command.h"
#include "support/expect.h"

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

std::vector<std::string> render_to(const fs::path& image, const std::vector<std::string>& more = {}) {
    return joined({CANDELA_TEST_COMMAND, "render", "-o", image.string(), "--width", "1500", "--height",
                   "1500", "--samples", "1", "--threads", "1"},
                  more);
}

std::vector<fs::path> files_in(const fs::path& directory) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(directory)) files.push_back(entry.path());
    return files;
}

/// Whether a process has a file of that directory open for as long as it writes: if the file system supports
/// unnamed files, they are invisible in the directory.
bool has_a_file_open_in(const fs::path& directory, pid_t process) {
    std::error_code problem;
    const fs::path descriptors = fs::path("/proc") / std::to_string(process) / "fd";
    for (fs::directory_iterator entry(descriptors, problem), end; !problem && entry != end;
         entry.increment(problem)) {
        std::error_code closed_meanwhile;
        const fs::path target = fs::read_symlink(entry->path(), closed_meanwhile);
        if (!closed_meanwhile && target.string().starts_with(directory.string() + "/")) return true;
    }
    return false;
}

/// Waits until the program writes or has ended.
bool wait_for_writing(const RunningProgram& program, const fs::path& directory) {
    while (!program.has_ended()) {
        if (has_a_file_open_in(directory, program.pid())) return true;
    }
    return false;
}

bool has_files_without_names(const fs::path& directory) {
    const int descriptor = ::open(directory.c_str(), O_TMPFILE | O_WRONLY, 0600);
    if (descriptor >= 0) ::close(descriptor);
    return descriptor >= 0;
}

/// In a child: makes the file system seem to lack unnamed files for programs started from here.
void refuse_files_without_names() {
    constexpr auto k_flags = offsetof(seccomp_data, args) + 2 * sizeof(__u64);  // little endian
    constexpr auto k_tmpfile = static_cast<__u32>(O_TMPFILE & ~O_DIRECTORY);
    std::array<sock_filter, 6> program = {{
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_openat, 0, 3),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, k_flags),
        BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, k_tmpfile, 0, 1),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EOPNOTSUPP),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
    }};
    const sock_fprog all = {static_cast<unsigned short>(program.size()), program.data()};
    if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
        ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &all) != 0)
        ::_exit(125);
}

/// The default scene, and a version of it that differs, as `extension`.
struct TwoImages {
    TwoImages(const fs::path& directory, const std::string& extension) {
        const fs::path file = directory / ("picture." + extension);
        succeeded(run_program(render_to(file, {"--set", "object.cube.color=[40,90,235]"})));
        old_bytes = read_file(file);
        const auto begin = Clock::now();
        succeeded(run_program(render_to(file)));
        seconds = Seconds(Clock::now() - begin).count();
        new_bytes = read_file(file);
        REQUIRE((old_bytes != new_bytes));
        fs::remove(file);
    }
    bool is_whole(const fs::path& file) const {
        const std::string bytes = read_file(file);
        return bytes == old_bytes || bytes == new_bytes;
    }

    std::string old_bytes, new_bytes;
    double seconds = 0;  // for rendering and writing
};

/// Kills renders at 100 moments or more, half of them while the picture is written; half of them have an old
/// picture to replace.
void kill_a_hundred_times(const std::string& extension) {
    const fs::path scratch = scratch_directory();
    const fs::path directory = scratch / "pictures";
    fs::create_directory(directory);
    const fs::path image = directory / ("picture." + extension);
    const TwoImages two(scratch, extension);
    std::mt19937 random(20240611);
    int killed = 0, killed_writing = 0, finished = 0;
    // On a busy machine, more of them come too late.
    for (int i = 0; i < 100 || (killed_writing < 5 && i < 1000); ++i) {
        const bool replaces = i % 2 == 0;
        for (const fs::path& file : files_in(directory)) fs::remove(file);
        if (replaces) write_file(image, two.old_bytes);
        const double part = std::uniform_real_distribution<double>(0, 1)(random);
        RunningProgram program(render_to(image));
        bool is_writing = false;
        if (i % 4 < 2) {
            std::this_thread::sleep_for(Seconds(part * two.seconds));
        } else {
            is_writing = wait_for_writing(program, directory);
            std::this_thread::sleep_for(Seconds(0.1 * part * two.seconds));
        }
        program.send(SIGKILL);
        const int exit_code = program.wait().exit_code;
        REQUIRE((exit_code == 0 || exit_code == 128 + SIGKILL));
        killed += exit_code == 128 + SIGKILL ? 1 : 0;
        killed_writing += exit_code == 128 + SIGKILL && is_writing ? 1 : 0;
        finished += exit_code == 0 ? 1 : 0;
        INFO("trial " << i << ", exit code " << exit_code);
        if (replaces || exit_code == 0) REQUIRE(fs::exists(image));
        const std::vector<fs::path> files = files_in(directory);
        for (const fs::path& file : files) REQUIRE(two.is_whole(file));
        // Between two system calls, a complete new picture has a name next to the old one; nowhere else is
        // there litter.
        if (has_files_without_names(directory)) REQUIRE(files.size() <= (replaces ? 2 : 1));
    }
    INFO(killed << " killed, " << killed_writing << " of them while writing; " << finished
                << " had finished");
    CHECK(killed >= 30);
    CHECK(killed_writing >= 5);
}

/// The old picture is untouched and alone.
void check_only_old(const fs::path& image, const std::string& old_bytes) {
    CHECK((read_file(image) == old_bytes));
    CHECK(files_in(image.parent_path()).size() == 1);
}

}  // namespace

TEST_CASE("killed at any moment, a PNG is the old one or the new one, never half of it") {
    kill_a_hundred_times("png");
}

TEST_CASE("killed at any moment, a PPM is the old one or the new one, never half of it", "[whole]") {
    kill_a_hundred_times("ppm");
}

TEST_CASE("killed at any moment, an EXR leaves nothing in the directory of temporary files") {
    const fs::path directory = scratch_directory();
    const fs::path image = directory / "pictures" / "picture.exr";
    const fs::path temporary = directory / "temporary";
    fs::create_directory(image.parent_path());
    fs::create_directory(temporary);
    const CommandSetup setup{.environment = {{"TMPDIR", temporary.string()}}};
    succeeded(run_program(render_to(image), setup));
    int killed_writing = 0;
    for (int i = 0; i < 10; ++i) {
        fs::remove(image);
        RunningProgram program(render_to(image), setup);
        const bool is_writing = wait_for_writing(program, image.parent_path());
        std::this_thread::sleep_for(std::chrono::milliseconds(5 * i));
        program.send(SIGKILL);
        killed_writing += program.wait().exit_code == 128 + SIGKILL && is_writing ? 1 : 0;
        CHECK(files_in(temporary).empty());
    }
    CHECK(killed_writing >= 1);
}

TEST_CASE("SIGINT, SIGTERM and SIGHUP while a picture is written leave the old one, and nothing next to it") {
    const fs::path directory = scratch_directory();
    const fs::path image = directory / "picture.png";
    for (const bool without_names : {true, false}) {
        int caught = 0;
        for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGINT, SIGTERM, SIGHUP}) {
            write_file(image, "old");
            CommandSetup setup;
            if (!without_names) setup.prepare = refuse_files_without_names;
            RunningProgram program(render_to(image), setup);
            wait_for_writing(program, directory);
            program.send(signal);
            const CommandResult result = program.wait();
            INFO("signal " << signal << ", files without names: " << without_names << "\n" << result.err);
            REQUIRE((result.exit_code == 0 || result.exit_code == 128 + signal));
            CHECK(files_in(directory).size() == 1);
            if (result.exit_code == 0) continue;  // too late
            CHECK(read_file(image) == "old");
            ++caught;
        }
        CHECK(caught >= 1);
    }
}

TEST_CASE("an ignored SIGHUP (nohup) stays ignored") {
    const fs::path image = scratch_directory() / "picture.png";
    CommandSetup setup;
    setup.prepare = [] { ::signal(SIGHUP, SIG_IGN); };
    RunningProgram program(render_to(image), setup);
    wait_for_writing(program, image.parent_path());
    program.send(SIGHUP);
    CHECK(program.wait().exit_code == 0);
}

TEST_CASE("on a file system without unnamed files, pictures are complete and keep their permissions") {
    const fs::path directory = scratch_directory();
    const fs::path image = directory / "picture.png";
    CommandSetup setup;
    setup.prepare = [] {
        ::umask(027);
        refuse_files_without_names();
    };
    succeeded(run_program(render_to(image), setup));
    CHECK(static_cast<int>(fs::status(image).permissions()) == 0640);
    const std::string bytes = read_file(image);
    fs::permissions(image, fs::perms::owner_read | fs::perms::owner_write);
    succeeded(run_program(render_to(image), setup));
    CHECK(static_cast<int>(fs::status(image).permissions()) == 0600);
    check_only_old(image, bytes);
}

TEST_CASE("a picture beyond the file size limit is an error, and the old one stays") {
    const fs::path directory = scratch_directory();
    const fs::path image = write_file(directory / "picture.ppm", "old");
    for (const bool without_names : {true, false}) {
        CommandSetup setup;
        setup.prepare = [without_names] {
            const rlimit limit = {1 << 20, 1 << 20};
            if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) ::_exit(125);
            if (!without_names) refuse_files_without_names();
        };
        expect(run_program(render_to(image), setup), 1, {"picture.ppm' cannot be written: File too large"});
        check_only_old(image, "old");
    }
}

TEST_CASE("a directory that cannot be written to is an error, and the old picture stays") {
    // Somewhere that others may enter; the build folder may not be such a place.
    const fs::path directory = fs::temp_directory_path() / ("candela-test-" + std::to_string(::getpid()));
    fs::create_directory(directory);
    const fs::path image = write_file(directory / "picture.png", "old");
    fs::permissions(directory, fs::perms::owner_read | fs::perms::owner_exec | fs::perms::group_read |
                                   fs::perms::group_exec | fs::perms::others_read | fs::perms::others_exec);
    std::vector<std::string> as_nobody;
    if (::geteuid() == 0) {
        as_nobody = {"setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"};
        if (run_program(joined(as_nobody, {CANDELA_TEST_COMMAND, "--version"})).exit_code != 0) {
            fs::remove_all(directory);
            SKIP("nobody else can run the command here");
        }
    }
    for (const char* const name : {"picture.png", "new.png"}) {
        expect(run_program(joined(as_nobody, render_to(directory / name))), 1,
               {"cannot be created: Permission denied"});
        check_only_old(image, "old");
    }
    fs::permissions(directory,
                    fs::perms::owner_all);  // otherwise a user other than root could not clean it up
    fs::remove_all(directory);
}

TEST_CASE("the longest possible name and a dangling link can be written to") {
    const fs::path directory = scratch_directory();
    const fs::path file = directory / (std::string(251, 'a') + ".ppm");
    for (int i = 0; i < 2; ++i) CHECK(run_program(render_to(file)).exit_code == 0);
    CHECK(files_in(directory).size() == 1);
    fs::remove(file);

    fs::create_symlink("there.ppm", directory / "link.ppm");
    for (int i = 0; i < 2; ++i) CHECK(run_program(render_to(directory / "link.ppm")).exit_code == 0);
    CHECK(fs::is_symlink(directory / "link.ppm"));
    CHECK(fs::is_regular_file(directory / "there.ppm"));
    CHECK(files_in(directory).size() == 2);
}
