// The choice between plugins of one name if one of them cannot be used: another is never used silently.
#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

/// A folder with a copy of a shipped plugin.
struct Copy {
    explicit Copy(const std::string& id) : folder(scratch_directory() / "plugins") {
        fs::create_directory(folder);
        for (const char* const extension : {".so", ".json"}) {
            const std::string file = id + extension;
            fs::copy_file(fs::path(CANDELA_TEST_PLUGINS) / file, folder / file);
        }
        library = folder / (id + ".so");
        manifest = folder / (id + ".json");
    }
    /// Renders the default scene, which needs shape/cube, with the folder given by an option or by the
    /// environment.
    CommandResult render(bool is_named, const std::vector<std::string>& more = {}) const {
        return run(joined({"render", "-o", (folder.parent_path() / "a.png").string()}, more), is_named);
    }
    std::string doctor(bool is_named) const { return run({"plugin", "doctor"}, is_named).out; }
    CommandResult run(const Words& words, bool is_named) const {
        if (is_named) return run_candela(joined(words, {"--plugin-dir", folder.string()}));
        return run_candela(words, {.environment = {{"CANDELA_PLUGIN_PATH", folder.string()}}});
    }

    fs::path folder, library, manifest;
};

/// Expects a warning about a refused copy that was only on the search path, and an error about a named one.
void check_refused(const Copy& copy, const std::string& reason) {
    const CommandResult found = copy.render(false);
    INFO(reason << '\n' << found.err);
    CHECK(found.exit_code == 0);
    CHECK(holds(found.err, "candela: warning: plugin '" + copy.library.string() + "' is refused: "));
    CHECK(holds(found.err, reason));
    CHECK(holds(found.err, "; using '"));
    CHECK(holds(found.err, "shape-cube.so' instead"));
    CHECK(fs::remove(copy.folder.parent_path() / "a.png"));
    const CommandResult named = copy.render(true);
    INFO(named.err);
    CHECK(named.exit_code != 0);
    CHECK(holds(named.err, "error: plugin '" + copy.library.string() + "' is refused: "));
    CHECK(holds(named.err, reason));
    CHECK_FALSE(fs::exists(copy.folder.parent_path() / "a.png"));
    // The doctor reports both the same way.
    const std::string diagnosis = copy.doctor(false);
    CHECK(holds(diagnosis, "refused: "));
    CHECK(holds(diagnosis, "in use: shape/cube"));
    CHECK(holds(copy.doctor(true), "not used: the one named by --plugin-dir was refused"));
}

}  // namespace

TEST_CASE("a working plugin silently takes precedence over the shipped one") {
    const Copy copy("shape-cube");
    for (const bool is_named : {true, false}) {
        const CommandResult result = copy.render(is_named);
        CHECK(result.exit_code == 0);
        CHECK_FALSE(holds(result.err, "warning"));
        CHECK(holds(copy.doctor(is_named), "hidden by " + copy.library.string()));
    }
}

TEST_CASE("a truncated library causes a message, not a bus error") {
    const Copy copy("shape-cube");
    const auto size = fs::file_size(copy.library);
    for (const auto left : {size - 1, size - 4096, size / 2, size / 10, std::uintmax_t{64}, std::uintmax_t{5},
                            std::uintmax_t{0}}) {
        fs::resize_file(copy.library, left);
        check_refused(copy, "it cannot be loaded (it ");
    }
}

TEST_CASE("a plugin without its manifest, with another's, or with an invalid one is refused") {
    const Copy copy("shape-cube");
    const std::string manifest = read_file(copy.manifest);
    write_file(copy.manifest, "{}");
    check_refused(copy, "cannot be used");
    write_file(copy.manifest, read_file(fs::path(CANDELA_TEST_PLUGINS) / "shape-torus.json"));
    check_refused(copy, "its manifest is that of shape/torus");
    fs::remove(copy.manifest);
    check_refused(copy, ".json is missing");
    fs::create_symlink("nowhere", copy.manifest);
    check_refused(copy, "its manifest cannot be read: it is a dangling link");
    fs::remove(copy.manifest);
    write_file(copy.manifest, manifest);
    fs::remove(copy.library);
    fs::create_symlink("nowhere", copy.library);
    check_refused(copy, "it cannot be read: it is a dangling link");
}

TEST_CASE("a library that others can modify is refused, unless the user allows it") {
    const Copy copy("shape-cube");
    fs::permissions(copy.library, fs::perms::others_write, fs::perm_options::add);
    check_refused(copy, "is writable by every user");
    CHECK(copy.render(true, {"--allow-untrusted-plugins"}).exit_code == 0);
}

TEST_CASE("a picture format from --plugin-dir is not replaced by another plugin that can write it") {
    const Copy copy("image-png");
    fs::resize_file(copy.library, 1000);
    const CommandResult named = copy.render(true);
    CHECK(named.exit_code == 1);
    CHECK(holds(named.err, "image-png.so' is refused"));
    const CommandResult found = copy.render(false);
    CHECK(found.exit_code == 0);
    CHECK(holds(found.err, "image-png.so' is refused"));
}

TEST_CASE("a quiet command suppresses the warning, not the error") {
    const Copy copy("shape-cube");
    fs::resize_file(copy.library, 1000);
    CHECK(copy.render(false, {"-q"}).err.empty());
    CHECK(holds(copy.render(true, {"-q"}).err, "is refused"));
}
