// The conformance kit names the fault of each faulty plugin.
#include <sched.h>
#include <sys/resource.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <ios>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/text.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// The kit's output for a library, and its exit code.
struct Verdicts {
    int exit_code;
    json checks;

    /// The outcome of the check whose name begins so.
    std::string of(const std::string& check) const {
        for (const json& c : checks) {
            if (c["check"].get<std::string>().starts_with(check)) return c["outcome"];
        }
        return "missing";
    }
    std::string messages(const std::string& check) const {
        for (const json& c : checks) {
            if (c["check"].get<std::string>().starts_with(check)) return c["messages"].dump();
        }
        return "";
    }
};

Verdicts judged(const fs::path& library, std::vector<std::string> options = {}) {
    const CommandResult result = run_program(joined({CANDELA_TEST_KIT, library.string(), "--json"}, options));
    INFO(result.err << result.out);
    const json report = json::parse(result.out);
    REQUIRE(report.size() == 1);
    CHECK(report[0]["conforms"] == (result.exit_code == 0));
    return {result.exit_code, report[0]["checks"]};
}

fs::path library_of(const std::string& name) {
    return fs::path(CANDELA_TEST_FAULTY_PLUGINS) / (name + ".so");
}

/// The processes that have loaded a library.
std::vector<std::string> processes_with(const std::string& library) {
    std::vector<std::string> found;
    for (const fs::directory_entry& entry : fs::directory_iterator("/proc")) {
        const std::string name = entry.path().filename().string();
        if (name.find_first_not_of("0123456789") != std::string::npos) continue;
        // Other users' processes cannot be read, nor can those that have ended, even after the file was
        // opened.
        try {
            if (read_file(entry.path() / "maps").find("/" + library) != std::string::npos)
                found.push_back(name);
        } catch (const std::ios_base::failure&) {
        }
    }
    return found;
}

template <class Condition>
bool comes_true(const Condition& condition) {
    for (int i = 0; i < 400; ++i) {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
}

struct Fault {
    const char* plugin;
    const char* check;
    const char* outcome;
    const char* message;
};

}  // namespace

TEST_CASE("a plugin without fault conforms") {
    const Verdicts verdicts = judged(library_of("reflection-faultless"));
    INFO(verdicts.checks.dump(2));
    CHECK(verdicts.exit_code == 0);
    for (const char* const check :
         {"handshake", "symbols", "finite", "batches", "bounds", "adding", "repeatable", "independent",
          "horizon", "grazing", "reciprocal", "energy-bounded", "isotropic"}) {
        INFO(check);
        CHECK(verdicts.of(check) == "passed");
    }
}

TEST_CASE("the kit names the fault of each faulty plugin, and its exit code is 4") {
    const std::vector<Fault> faults = {
        {"reflection-traps-on-load", "handshake", "crashed", "SIGILL"},
        {"reflection-exports-a-helper", "symbols", "failed", "matt_factor"},
        {"reflection-throws-on-create", "instances", "failed", "create() threw 'out of paint'"},
        {"reflection-throws-a-number", "finite", "failed", "Unknown exception"},
        {"reflection-throws-in-ambient", "finite", "failed", "no ambience"},
        {"reflection-not-a-number", "finite", "failed", "reflect returns -nan as diffuse, for N = "},
        {"reflection-writes-past-the-end", "bounds", "failed", "reflect writes after a batch of 1 points"},
        {"reflection-changes-its-inputs", "bounds", "failed", "reflect changes its inputs"},
        {"reflection-overwrites", "adding", "failed",
         "reflect does not add to the diffuse that is already there"},
        {"reflection-calls-exit", "finite", "crashed", "the plugin ended the process, with exit code 0"},
        {"reflection-aborts", "finite", "crashed", "SIGABRT"},
        {"reflection-leaves-a-thread", "instances", "failed", "threads running"},
        {"reflection-lies-about-reciprocity", "reciprocal", "failed", "it is not reciprocal"},
        {"reflection-makes-energy", "energy-bounded", "failed", "times the incident light"},
        {"reflection-says-otherwise", "kernel as C++", "failed", "the kernel's text computes"},
        {"reflection-reads-undeclared", "kernel as C++", "failed", "the kernel's text computes"},
        {"reflection-exports-another-table", "kernel as C++", "failed", "the kernel's text computes"},
        {"reflection-speaks-no-cpp", "kernel as C++", "failed", "does not compile as C++"},
        {"reflection-speaks-no-glsl", "kernel as GLSL", "failed", "does not compile as GLSL 330 core"},
        {"target-approximates-what-is-exact", "exact models", "failed", "becomes reflection/phong"},
        {"image-swaps-channels", "round trip", "failed", "comes back"},
        {"image-says-it-is-written", "failing writes", "failed", "reports nothing"},
        {"image-leaves-a-file", "files of its own", "failed", "picture.tmp"},
        {"reflection-outshines-its-surroundings", "surroundings", "failed", "surrounded by 1, it shows 1.2"},
        {"reflection-lies-about-isotropy", "isotropic", "failed", "turned by 0.5 rad about N"},
        {"reflection-lights-the-night", "horizon", "failed", "degrees below the horizon is reflected"},
        {"reflection-rolls-dice", "repeatable", "failed", "a different result the second time"},
        {"reflection-miscounts", "batches", "failed", "in a batch of 7"},
        {"reflection-shares-its-state", "independent", "failed", "while other instances exist"},
        {"reflection-is-negative", "finite", "failed", "a negative diffuse"},
        {"reflection-default-out-of-range", "parameters", "failed",
         "the default of 'kd': [1.5, 1.5, 1.5] is outside its range"},
        {"shading-long-normals", "unit", "failed", "a vector of length 2"},
        {"shading-nan-in-slivers", "degenerate", "failed",
         "where interpolated normals, derivatives or edges vanish"},
        {"shading-last-face-wins", "order", "failed", "with another numbering"},
        {"shading-denies-its-weights", "defaults", "failed", "declares default_vertex_normals"},
        {"shape-claims-to-be-convex", "convex", "failed", "m above triangle"},
        {"shape-inside-out", "closed", "failed", "it is inside out"},
        {"shape-hole-in-it", "closed", "failed", "3 edges that do not lie between two triangles"},
        {"light-long-directions", "directions", "failed", "a direction of length"},
        {"light-long-directions", "fall-off", "failed", "declared to fade with distance"},
        {"reflection-adds-past-the-end", "bounds", "failed", "writes after a batch of 7 points"},
        {"reflection-reads-past-the-end", "bounds", "failed", "reflect reads past the end of to_observer.x"},
        {"reflection-reads-behind-the-batch", "bounds", "failed",
         "reflect reads past the end of normal.x, in a batch of 1 points"},
        {"reflection-reads-before-the-batch", "bounds", "failed",
         "reflect_ambient reads before the beginning of ambient.z"},
        {"light-reads-behind-the-batch", "bounds", "failed", "reads past the end of position.y"},
        {"shading-reads-behind-the-batch", "bounds", "failed", "normals reads past the end of face_normal.x"},
        {"shading-reads-behind-the-batch", "mesh", "failed",
         "vertex_normals() reads past the end of position.z"},
        {"shape-reads-behind-its-mesh", "bounds", "failed", "tessellate() reads past the end of indices"},
        {"image-writes-behind-what-it-reads", "bounds", "failed",
         "reading a .runs of 1 x 1, it writes past the end of the picture"},
        {"image-reads-behind-the-image", "bounds", "failed", "it reads past the end of bytes"},
        {"reflection-glows-at-the-rim", "energy-bounded", "failed", "towards an observer at 88 degrees"},
        {"reflection-declares-in-vain", "declarations", "failed", "did you mean 'reciprocal'?"},
        {"reflection-declares-in-vain", "declarations", "failed", "'closed' is a property of a shape plugin"},
        {"reflection-declares-in-vain", "declarations", "failed",
         "is about 'kq', but there is no such parameter"},
        {"reflection-declares-in-vain", "declarations", "failed", "it has no parameter 'shape'"},
        {"reflection-declares-in-vain", "declarations", "failed",
         "preset 'plaster' has [1.5, 0.5, 0.5] for 'kd'"},
        {"reflection-declares-in-vain", "declarations", "failed", "it has two presets called 'plaster'"},
        {"reflection-shares-its-scratch", "repeatable", "failed", "when 8 threads call it at once"},
        {"reflection-knows-where-up-is", "frame", "failed", "depends on the world's axes"},
        {"reflection-leaks", "instances", "failed", "KiB of memory"},
        {"reflection-careless-kernel", "kernel names", "failed",
         "careless-kernel.kernel:6: 'squared' may be declared by another kernel"},
        {"reflection-careless-kernel", "kernel as C++", "failed",
         "careless-kernel.kernel:15:11: warning: unused variable 'unused'"},
        {"reflection-careless-kernel", "kernel as C++", "failed",
         "careless-kernel.kernel:17:9: warning: variable 'cosine' is used uninitialized"},
        {"shading-loses-flat-faces", "finite", "failed", "normals returns"},
        {"shading-loses-flat-faces", "plane", "failed", "a point of the plane y = 0 has the normal"},
        {"light-points-away", "towards", "failed", "its position is on the other side"},
        {"light-forgets-highlights", "written", "failed", "does not write the specular of point 0"},
        {"light-describes-another", "data", "failed", "as data, sample 0 sends 1 in red; illuminate() sends"},
        {"light-is-behind-itself", "distance", "failed", "sample 0 is -1 m away"},
        {"light-dims-for-shadows", "distance", "failed", "if it is asked for its distance"},
        {"light-spreads-without-end", "distance", "failed", "the extent of sample 0 is not finite"},
        {"reflection-forgets-a-light", "in one go", "failed", "reflect_all_lights returns"},
        {"reflection-misjudges-its-highlight", "highlight width", "failed", "its highlight reflects"},
        {"reflection-same-parameters-everywhere", "varying", "failed", "with parameters of its own"},
        {"reflection-one-color-for-all", "colours", "failed", "where the surface has that colour"},
        {"reflection-hasty-at-the-end", "bounds", "failed",
         "reflect_all_lights writes after a batch of 1 points"},
        {"light-never-fades", "fall-off", "failed", "it sends 1 times as much"},
        {"shape-shares-its-scratch", "repeatable", "failed", "different while other threads make theirs"},
        {"shape-half-derivatives", "derivatives", "failed", "edges dp/du and dp/dv disagree"},
        {"image-shares-its-scratch", "repeatable", "failed", "a different file while other threads write"},
        {"image-miscounts-long-runs", "round trip", "failed", "come back different"},
        {"image-layers-out-of-order", "layers", "failed", "comes back as"},
        {"image-reads-what-is-cut-off", "truncated", "failed", "is read as if it were whole"},
    };
    for (const Fault& fault : faults) {
        const Verdicts verdicts =
            judged(library_of(fault.plugin), {"--time-limit", "20", "--check", fault.check});
        INFO(fault.plugin << ": " << verdicts.checks.dump(2));
        CHECK(verdicts.exit_code == 4);
        CHECK(verdicts.of(fault.check) == fault.outcome);
        CHECK(holds(verdicts.messages(fault.check), fault.message));
    }
}

TEST_CASE("an unread variable of a kernel is a warning, and the plugin conforms") {
    const Verdicts verdicts =
        judged(library_of("reflection-unfinished-kernel"), {"--check", "kernel as C++"});
    INFO(verdicts.checks.dump(2));
    CHECK(verdicts.exit_code == 0);
    CHECK(verdicts.of("kernel as C++") == "warning");
    CHECK(holds(verdicts.messages("kernel as C++"),
                "unfinished-kernel.kernel:11:11: warning: unused variable 'later'"));
}

TEST_CASE("a faultless plugin that needs a file conforms if it is given one, and is not judged without") {
    const fs::path file = write_file(scratch_directory() / "brightness.txt", "0.5\n");
    const Verdicts given = judged(library_of("reflection-reads-a-file"), {"--set", "file=" + file.string()});
    INFO(given.checks.dump(2));
    CHECK(given.exit_code == 0);
    for (const char* const check : {"instances", "finite", "horizon", "grazing", "reciprocal"}) {
        INFO(check);
        CHECK(given.of(check) == "passed");
    }
    const Verdicts without = judged(library_of("reflection-reads-a-file"), {"--check", "finite"});
    CHECK(without.of("finite") == "skipped");
    CHECK(holds(without.messages("finite"), "--set NAME=FILE"));
    CHECK(holds(
        judged(library_of("reflection-reads-a-file"), {"--set", "fil=" + file.string(), "--check", "finite"})
            .messages("finite"),
        "it has no parameter 'fil'"));
}

TEST_CASE("an impossible request to the kit is a usage error, not a conforming plugin") {
    const std::string library = library_of("reflection-is-negative").string();
    const std::vector<std::pair<std::vector<std::string>, const char*>> mistakes = {
        {{library, "--check", "finnite"}, "has 'finnite' in its name; did you mean 'finite'?"},
        {{library, "--check", "samples:"}, "--list reflection shows them"},
        {{library, "--time-limit", "0"}, "--time-limit is 0; it must be more than 0"},
        {{library, "--time-limit", "-1"}, "--time-limit is -1"},
        {{library, "--time-limit", "nan"}, "--time-limit is nan"},
        {{"--list", "reflexion"}, "unknown plugin kind 'reflexion'; did you mean 'reflection'?"},
    };
    for (const auto& [options, message] : mistakes) {
        const CommandResult result = run_program(joined({CANDELA_TEST_KIT}, options));
        INFO(message << "\n" << result.err << result.out);
        CHECK(result.exit_code == 2);
        CHECK(result.out.empty());
        CHECK(holds(result.err, message));
    }
}

TEST_CASE("a property may be declared for only some values, and is verified for those") {
    const fs::path directory = scratch_directory();
    const auto energy = [&](const char* brightness) {
        return judged(library_of("reflection-reads-a-file"),
                      {"--check", "energy-bounded", "--set",
                       "file=" + write_file(directory / "brightness.txt", brightness).string()})
            .of("energy-bounded");
    };
    CHECK(energy("0.5") == "passed");
    CHECK(energy("1.2") == "failed");
}

TEST_CASE("on one processor, threads that share memory are found without waiting for them") {
    CommandSetup setup;
    setup.prepare = [] {
        cpu_set_t one;
        CPU_ZERO(&one);
        CPU_SET(::sched_getcpu(), &one);
        ::sched_setaffinity(0, sizeof one, &one);
        const rlimit seconds{5, 5};  // of processor time
        ::setrlimit(RLIMIT_CPU, &seconds);
    };
    const auto repeated = [&](const fs::path& library) {
        return run_program({CANDELA_TEST_KIT, library.string(), "--check", "repeatable"}, setup);
    };
    const CommandResult shared = repeated(library_of("reflection-shares-its-scratch"));
    INFO(shared.out << shared.err);
    CHECK(holds(shared.out, "when 8 threads call it at once"));
    // Of the shipped plugins, this one needs the most calls.
    expect(repeated(fs::path(CANDELA_TEST_PLUGINS) / "light-distributed.so"), 0);
}

TEST_CASE("in one process, for a debugger, the verdicts are the same") {
    const Verdicts verdicts = judged(library_of("reflection-is-negative"), {"--in-process"});
    INFO(verdicts.checks.dump(2));
    CHECK(verdicts.exit_code == 4);
    CHECK(verdicts.of("finite") == "failed");
    CHECK(verdicts.of("bounds") == "passed");
}

TEST_CASE("processes that a plugin starts end with its check, even if they hide in their own session") {
    const Verdicts verdicts = judged(library_of("reflection-leaves-a-process"), {"--check", "finite"});
    INFO(verdicts.checks.dump(2));
    CHECK(verdicts.of("finite") == "passed");
    CHECK(processes_with("reflection-leaves-a-process.so").empty());
}

TEST_CASE("a plugin that hangs, and the processes that it has started, end when the kit is killed") {
    const fs::path library = library_of("reflection-hangs-with-a-child");
    RunningProgram kit({CANDELA_TEST_KIT, library.string(), "--check", "finite"});
    const auto count = [&] { return processes_with("reflection-hangs-with-a-child.so").size(); };
    // The check, and its child. The kit and its guardian do not load the library.
    REQUIRE(comes_true([&] { return count() == 2; }));
    kit.send(SIGKILL);
    CHECK(comes_true([&] { return count() == 0; }));
}

TEST_CASE("a plugin that never returns is stopped at the time limit, and after two such checks for good") {
    for (const char* const kind : {"reflection", "light", "shading", "shape"}) {
        const Verdicts verdicts =
            judged(library_of(std::string(kind) + "-never-returns"), {"--time-limit", "1"});
        INFO(kind << verdicts.checks.dump(2));
        CHECK(verdicts.exit_code == 4);
        int late = 0;
        for (const json& check : verdicts.checks) {
            if (late == 2) {
                CHECK(check["outcome"] == "skipped");
                CHECK(holds(check["messages"].dump(), "2 checks have not finished"));
            } else if (check["outcome"] == "timed out") {
                ++late;
                CHECK(holds(check["messages"].dump(), "not finished after 1 s"));
            }
        }
        CHECK(late == 2);
    }
}

TEST_CASE("a check's result is shown before the next one has ended, even through a pipe") {
    const fs::path shown = scratch_directory() / "shown.txt";
    // Its output is a pipe; the kit hangs in its second check that calls the plugin.
    RunningProgram kit({"sh", "-c", "\"$1\" \"$2\" --time-limit 3600 | cat > \"$3\"", "sh", CANDELA_TEST_KIT,
                        library_of("reflection-never-returns").string(), shown.string()});
    CHECK(comes_true([&] { return read_file(shown).find("passed    handshake") != std::string::npos; }));
    CHECK(comes_true([&] { return !processes_with("reflection-never-returns.so").empty(); }));
    CHECK(!kit.has_ended());
    for (const std::string& process : processes_with("reflection-never-returns.so"))
        ::kill(std::stoi(process), SIGKILL);
}

TEST_CASE("a manifest that disagrees, is missing or is broken is found before anything runs") {
    const fs::path directory = scratch_directory();
    const fs::path library = directory / "reflection-faultless.so",
                   manifest = directory / "reflection-faultless.json";
    fs::copy_file(library_of("reflection-faultless"), library);
    CHECK(holds(judged(library).messages("handshake"), "cannot be read"));
    std::string text = read_file(library_of("reflection-faultless").replace_extension(".json"));
    write_file(manifest, text);
    CHECK(judged(library).exit_code == 0);
    const std::size_t at = text.find("\"title\": \"");
    REQUIRE(at != std::string::npos);
    write_file(manifest, text.substr(0, at + 10) + "Other" + text.substr(at + 10));
    const Verdicts wrong = judged(library);
    CHECK(wrong.of("handshake") == "failed");
    CHECK(holds(wrong.messages("handshake"), "disagrees with it about its title"));
    CHECK(wrong.of("finite") == "skipped");
    write_file(manifest, "{");
    CHECK(judged(library).of("handshake") == "failed");
}

TEST_CASE("a library under another name, or with a missing dependency, is named") {
    const fs::path directory = scratch_directory();
    fs::copy_file(library_of("reflection-faultless"), directory / "reflection-other.so");
    fs::copy_file(library_of("reflection-faultless").replace_extension(".json"),
                  directory / "reflection-other.json");
    CHECK(judged(directory / "reflection-other.so").of("file name") == "failed");

    const fs::path empty = write_file(directory / "empty.c", "");
    const fs::path needed = directory / "libnobodyhasthis.so";
    REQUIRE(
        run_program({CANDELA_TEST_COMPILER, "-shared", "-o", needed.string(), empty.string()}).exit_code ==
        0);
    const fs::path lonely = directory / "reflection-lonely.so";
    succeeded(run_program({CANDELA_TEST_COMPILER, "-shared", "-Wl,--no-as-needed", "-o", lonely.string(),
                           empty.string(), needed.string()}));
    fs::copy_file(directory / "reflection-other.json", directory / "reflection-lonely.json");
    fs::remove(needed);
    const Verdicts verdicts = judged(lonely);
    CHECK(verdicts.of("handshake") == "failed");
    CHECK(holds(verdicts.messages("handshake"), "libnobodyhasthis.so, which is not installed here"));
    CHECK_FALSE(holds(verdicts.messages("handshake"), "build it again"));
    CHECK_FALSE(holds(verdicts.messages("handshake"), "Bad file descriptor"));
}

#ifdef CANDELA_TEST_THREAD_SANITIZER
TEST_CASE(
    "a data race that does not change results is found by ThreadSanitizer, if a plugin is built with it") {
    const auto threads = [](const std::string& name) {
        const fs::path library = fs::path(CANDELA_TEST_THREADS_PLUGINS) / (name + ".so");
        return run_program({"env", CANDELA_TEST_SYMBOLIZER, CANDELA_TEST_THREAD_SANITIZER, CANDELA_TEST_KIT,
                            library.string(), "--in-process", "--check=threads at once"});
    };
    CHECK(judged(library_of("reflection-counts-its-calls")).exit_code == 0);
    const CommandResult racing = threads("reflection-counts-its-calls");
    INFO(racing.out << racing.err);
    CHECK(racing.exit_code != 0);
    CHECK(holds(racing.err, "WARNING: ThreadSanitizer: data race"));
    CHECK(holds(racing.err, "reflection-counts-its-calls.cpp:9"));
    const CommandResult sound = expect(threads("reflection-faultless"), 0);
    CHECK(sound.err == "");
}
#endif
