// The renderer survives every fault that a host can: a plugin's fault is an error that names the plugin, and
// no picture is left.
#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

struct Survived {
    std::vector<std::string> use;
    const char* message;
};

CommandResult rendered(const std::vector<std::string>& use, const fs::path& image) {
    return run_candela(
        joined({"render", "--plugin-dir", CANDELA_TEST_FAULTY_PLUGINS, "-o", image.string()}, use));
}

}  // namespace

TEST_CASE(
    "exceptions, out-of-bounds writes and non-finite results of plugins end in an error that names "
    "them") {
    const fs::path image = scratch_directory() / "a.png";
    const std::vector<Survived> faults = {
        {{"--reflection=throws-on-create"},
         "object 'cube': plugin reflection/throws-on-create: out of paint"},
        {{"--reflection=throws-a-number"},
         "plugin reflection/throws-a-number threw an object that is not a std::exception"},
        {{"--reflection=not-a-number", "--set", "light.lamp.position=[0, -0.9, -4]"},
         "plugin reflection/not-a-number returned a non-finite value"},
    };
    for (const Survived& fault : faults) {
        const CommandResult result = rendered(fault.use, image);
        INFO(fault.use.front() << "\n" << result.err);
        CHECK(holds(result.err, fault.message));
        CHECK(result.exit_code == 1);
        CHECK_FALSE(fs::exists(image));
    }
    const fs::path scene = write_file(scratch_directory() / "ambient.toml",
                                      "version = 1\n[observer]\nposition = [0, 0, 4]\nlook_at = [0, 0, 0]\n"
                                      "[[light]]\ntype = \"ambient\"\n[[object]]\ntype = \"cube\"\n");
    const CommandResult ambient =
        expect(rendered({scene.string(), "--shading=flat", "--reflection=throws-in-ambient"}, image), 1);
    CHECK(holds(ambient.err, "plugin reflection/throws-in-ambient: no ambience"));
}

TEST_CASE(
    "a plugin that writes past its batch, however far, is found or harmless, and never causes a crash") {
    const fs::path directory = scratch_directory();
    for (const char* const size : {"16", "64", "300"}) {
        const fs::path image = directory / "a.png";
        const CommandResult result =
            rendered({"--reflection=writes-past-the-end", "--width", size, "--height", size}, image);
        INFO(size << "\n" << result.err);
        CHECK((result.exit_code == 0 || result.exit_code == 1));
        if (result.exit_code == 1)
            CHECK(holds(result.err, "plugin reflection/writes-past-the-end wrote past the end of its batch"));
    }
    const CommandResult hasty = expect(rendered({"--reflection=hasty-at-the-end"}, directory / "d.png"), 1);
    CHECK(holds(hasty.err, "plugin reflection/hasty-at-the-end "));
    // 512 pixels per side fill whole batches, where it is found.
    CHECK(rendered({"--reflection=writes-past-the-end"}, directory / "b.png").exit_code == 1);
    expect(rendered({"--reflection=adds-past-the-end"}, directory / "c.png"), 1,
           {"plugin reflection/adds-past-the-end wrote past the end of its batch"});
}

TEST_CASE("listing, checking and using other plugins never loads one that traps") {
    expect(run_candela({"list", "--plugin-dir", CANDELA_TEST_FAULTY_PLUGINS}), 0);
    expect(run_candela({"describe", "reflection/traps-on-load", "--plugin-dir", CANDELA_TEST_FAULTY_PLUGINS}),
           0);
    CHECK(rendered({}, scratch_directory() / "a.png").exit_code == 0);
}

TEST_CASE("the doctor survives a plugin that traps, and names each plugin's problem") {
    const fs::path directory = scratch_directory();
    for (const char* const name : {"reflection-traps-on-load", "reflection-faultless"}) {
        for (const char* const extension : {".so", ".json"}) {
            const std::string file = std::string(name) + extension;
            fs::copy_file(fs::path(CANDELA_TEST_FAULTY_PLUGINS) / file, directory / file);
        }
    }
    write_file(directory / "light-text.so", "no library");
    write_file(directory / "shape-alone.json", "{}");
    fs::create_directory(directory / "second");
    for (const char* const file : {"reflection-faultless.so", "reflection-faultless.json"})
        fs::copy_file(fs::path(CANDELA_TEST_FAULTY_PLUGINS) / file, directory / "second" / file);
    const CommandResult result =
        expect(run_candela({"plugin", "doctor", "--plugin-dir", directory.string(), "--plugin-dir",
                            (directory / "second").string(), "--plugin-dir", directory.string()}),
               1);
    for (const char* const part :
         {"reflection-traps-on-load.so    refused: loading it ended the process with signal",
          "in use: reflection/faultless 1.0.0", "hidden by",
          "light-text.so                  refused: its manifest light-text.json is missing",
          "shape-alone.so                 refused: its manifest exists, but the library does not",
          "in use: light/point"}) {
        INFO(part);
        CHECK(holds(result.out, part));
    }
}

TEST_CASE(
    "however loading a library ends, the doctor reports it and terminates, and so does the manifest writer") {
    const fs::path directory = scratch_directory();
    const fs::path library = directory / "reflection-misbehaves-on-load.so";
    for (const char* const extension : {".so", ".json"}) {
        const std::string file = std::string("reflection-misbehaves-on-load") + extension;
        fs::copy_file(fs::path(CANDELA_TEST_FAULTY_PLUGINS) / file, directory / file);
    }
    struct Ending {
        const char* what;
        const char* message;
    };
    for (const auto& [what, message] : {
             Ending{"exit", "refused: loading it ended the process with exit code 0"},
             Ending{"sleep", "refused: loading it did not finish within 2 s"},
             Ending{"stop", "refused: loading it did not finish within 2 s"},
             Ending{"throw", "refused: loading it "},
             Ending{"abort", "refused: loading it ended the process with signal Aborted"},
             Ending{"crash", "refused: loading it ended the process with signal Segmentation fault"},
             Ending{"close", "refused: loading it ended the process with exit code 0"},
             Ending{"fork", "starts a process that keeps running every time it is loaded"},
         }) {
        INFO(what);
        CommandSetup setup{.environment = {{"FAULTY_ON_LOAD", what}}};
        expect_out(
            run_candela({"plugin", "doctor", "--time-limit", "2", "--plugin-dir", directory.string()}, setup),
            1, {message, "in use: light/point"});
    }
    for (const auto& [what, message] : {Ending{"exit", "ended the process with exit code 0"},
                                        Ending{"abort", "ended the process with signal"}}) {
        CommandSetup setup{.environment = {{"FAULTY_ON_LOAD", what}}};
        const fs::path manifest = directory / "written.json";
        const CommandResult writer =
            run_program({CANDELA_TEST_MANIFEST_WRITER, library.string(), manifest.string()}, setup);
        INFO(what << writer.out << writer.err);
        CHECK(writer.exit_code == 1);
        CHECK(holds(writer.err, message));
        CHECK(!fs::exists(manifest));
    }
}

TEST_CASE("however loading a library ends, the conformance kit reports it and terminates") {
    const fs::path library = fs::path(CANDELA_TEST_FAULTY_PLUGINS) / "reflection-misbehaves-on-load.so";
    struct Ending {
        const char* what;
        const char* message;
    };
    for (const auto& [what, message] : {
             Ending{"exit", "the plugin ended the process, with exit code 0"},
             Ending{"sleep", "not finished after 2 s"},
             Ending{"stop", "not finished after 2 s"},
             Ending{"abort", "ended by signal SIGABRT"},
             Ending{"crash", "ended by signal SIGSEGV"},
             Ending{"close", "the plugin ended the process"},
         }) {
        CommandSetup setup{.environment = {{"FAULTY_ON_LOAD", what}}};
        const CommandResult result =
            run_candela({"plugin", "test", library.string(), "--time-limit", "2"}, setup);
        INFO(what << result.out << result.err);
        CHECK(result.exit_code == 4);
        CHECK(holds(result.out, message));
        CHECK(holds(result.out, "it cannot be loaded"));
    }
}

TEST_CASE("the doctor reports a refused plugin once, whether its folder's path is relative or absolute") {
    const fs::path directory = scratch_directory();
    fs::create_directory(directory / "plugins");
    fs::copy_file(fs::path(CANDELA_TEST_FAULTY_PLUGINS) / "reflection-faultless.so",
                  directory / "plugins" / "reflection-other.so");
    std::string manifest = read_file(fs::path(CANDELA_TEST_FAULTY_PLUGINS) / "reflection-faultless.json");
    const std::size_t at = manifest.find("\"faultless\"");
    REQUIRE(at != std::string::npos);
    write_file(directory / "plugins" / "reflection-other.json", manifest.replace(at, 11, "\"other\""));
    const CommandResult result =
        run_candela({"plugin", "doctor", "--plugin-dir", "plugins"}, {.directory = directory});
    INFO(result.out);
    CHECK(holds(result.out, "reflection-other.so            refused: its manifest disagrees"));
    CHECK_FALSE(holds(result.out, "refused: plugin"));
}

TEST_CASE("a new plugin with an existing plugin's name hides it, with a warning") {
    const fs::path directory = scratch_directory();
    expect(run_candela({"plugin", "new", "reflection", "lambert"}, {.directory = directory}), 0,
           {"a reflection plugin 'lambert' already exists"});
    CHECK(run_candela({"plugin", "new", "reflection", "velvet"}, {.directory = directory}).err.empty());
}

TEST_CASE("plugins that every user can change are refused, unless explicitly allowed") {
    const fs::path directory = scratch_directory();
    for (const char* const file : {"reflection-faultless.so", "reflection-faultless.json"})
        fs::copy_file(fs::path(CANDELA_TEST_FAULTY_PLUGINS) / file, directory / file);
    const std::vector<std::string> words{"describe", "reflection/faultless", "--plugin-dir",
                                         directory.string()};
    expect(run_candela(words), 0);
    const auto refused = [&] {
        const CommandResult result = run_candela(words);
        CHECK(holds(result.err, "is writable by every user, so anybody could run code here"));
        CHECK(result.exit_code == 1);
        std::vector<std::string> trusting = words;
        trusting.emplace_back("--allow-untrusted-plugins");
        expect(run_candela(trusting), 0);
    };
    fs::permissions(directory / "reflection-faultless.so", fs::perms::others_write, fs::perm_options::add);
    refused();
    fs::permissions(directory / "reflection-faultless.so", fs::perms::others_write, fs::perm_options::remove);
    fs::permissions(directory, fs::perms::others_write, fs::perm_options::add);
    refused();
}
