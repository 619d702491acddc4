// docs/plugins/versioning.md: a plugin works only with the interface version, and the layout, that it was
// built for.
#include "candela/plugin/abi.h"

#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "support/command.h"
#include "support/plugins.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

constexpr const char* k_progress = "CANDELA_TEST_OTHER_INTERFACE";

/// A fingerprint like this host's, with another interface version.
std::string fingerprint(int version) {
    std::string abi(candela::host_abi());
    const std::string here = "candela interface " + std::to_string(CANDELA_INTERFACE_VERSION) + ";";
    REQUIRE(abi.starts_with(here));
    return abi.replace(0, here.size(), "candela interface " + std::to_string(version) + ";");
}

/// A folder with the plugin `built`, and a manifest that claims `abi`.
fs::path installed(const std::string& built, const std::string& abi, const std::string& folder) {
    const fs::path directory = scratch_directory() / folder;
    fs::create_directory(directory);
    fs::copy_file(fs::path(CANDELA_TEST_LIBRARIES) / built, directory / "reflection-other-interface.so");
    candela::Manifest manifest;
    manifest.abi = abi;
    manifest.kind = candela::PluginKind::reflection;
    manifest.name = "other-interface";
    manifest.version = "1.0.0";
    manifest.title = "Other interface";
    write_file(directory / "reflection-other-interface.json", candela::to_json(manifest));
    return directory;
}

/// Like the above, with the plugin built for `version`.
fs::path installed(int version, const std::string& abi, const std::string& folder) {
    const std::string number = std::to_string(version);
    return installed("interface_" + number + ".so", abi, folder + "-" + number);
}

/// The message when an instance of the model is requested; empty if it is created.
std::string refusal(const fs::path& directory) {
    ::unsetenv(k_progress);
    candela::Registry registry({directory});
    return message_of<candela::Error>([&] {
        registry.create<candela::ReflectionModel>(
            "other-interface", registry.parameters(candela::PluginKind::reflection, "other-interface"),
            candela::ColorEncoding::none);
    });
}

/// How far the host got: "" not loaded, "loaded", "made" an instance.
std::string progress() {
    const char* const value = std::getenv(k_progress);
    return value != nullptr ? value : "";
}

std::string expected(const fs::path& directory, const std::string& abi) {
    return "plugin '" + (directory / "reflection-other-interface.so").string() +
           "' is refused: it was built for '" + abi + "', but this is '" + std::string(candela::host_abi()) +
           "'; build it again with this Candela's SDK";
}

std::string expected(const fs::path& directory, int version) {
    return expected(directory, fingerprint(version));
}

/// This host's fingerprint with `part` instead of `here`, which it must contain.
std::string fingerprint_with(const std::string& here, const std::string& part) {
    std::string abi(candela::host_abi());
    const auto at = abi.find(here);
    REQUIRE(at != std::string::npos);
    return abi.replace(at, here.size(), part);
}

}  // namespace

TEST_CASE("a plugin of the interface before or after this one is refused by its manifest, and not loaded") {
    const int version = GENERATE(CANDELA_INTERFACE_VERSION - 1, CANDELA_INTERFACE_VERSION + 1);
    const fs::path directory = installed(version, fingerprint(version), "honest");
    CHECK(refusal(directory) == expected(directory, version));
    CHECK(progress().empty());
}

TEST_CASE(
    "a plugin of another interface whose manifest lies is refused by the handshake, and creates nothing") {
    const int version = GENERATE(CANDELA_INTERFACE_VERSION - 1, CANDELA_INTERFACE_VERSION + 1);
    const fs::path directory = installed(version, std::string(candela::host_abi()), "lying");
    CHECK(refusal(directory) == expected(directory, version));
    CHECK(progress() == "loaded");
}

TEST_CASE("the same plugin built for this interface creates its model") {
    const fs::path directory =
        installed(CANDELA_INTERFACE_VERSION, std::string(candela::host_abi()), "equal");
    CHECK(refusal(directory).empty());
    CHECK(progress() == "made");
}

TEST_CASE("the command refuses a plugin of the interface before this one, and writes no picture") {
    const int version = CANDELA_INTERFACE_VERSION - 1;
    const bool lies = GENERATE(false, true);
    const fs::path directory = installed(
        version, lies ? std::string(candela::host_abi()) : fingerprint(version), lies ? "lies" : "told");
    const fs::path image = directory / "picture.png";
    const CommandResult result = run_candela({"render", "--plugin-dir", directory.string(), "--reflection",
                                              "other-interface", "-o", image.string()});
    INFO(result.err);
    CHECK(result.exit_code == (lies ? 1 : 3));  // found while checking the input, if the manifest is honest
    CHECK(holds(result.err, expected(directory, version)));
    CHECK_FALSE(fs::exists(image));
}

TEST_CASE(
    "a plugin built with a switch that changes what crosses the boundary is refused, and creates nothing") {
    const std::string size = std::to_string(sizeof(candela::PluginDescriptor));
    constexpr std::size_t k_flags =
        sizeof(bool) + sizeof(candela::SurfaceNeeds) + sizeof(candela::ShadingNeeds);
    // After the kind, and after the flags.
    constexpr std::size_t k_gaps = 4 + (8 - k_flags % 8) % 8;
    const auto [built, here, part] = GENERATE_COPY(table<std::string, std::string, std::string>(
        {{"no-rtti", "; rtti", "; no rtti"},
         {"no-exceptions", "; exceptions", "; no exceptions"},
         {"short-enums", "; enum 4", "; enum 1"},
         {"pack-struct", "; descriptor " + size,
          "; descriptor " + std::to_string(sizeof(candela::PluginDescriptor) - k_gaps)},
         {"debug-containers", "libstdc++ cxx11", "libstdc++ cxx11 debug"}}));
    CAPTURE(built);
    const fs::path directory = installed(built + ".so", std::string(candela::host_abi()), built);
    CHECK(refusal(directory) == expected(directory, fingerprint_with(here, part)));
    CHECK(progress() == "loaded");
}

TEST_CASE("a plugin built when the interface was modules only is refused by its manifest, and not loaded") {
    const std::string before = "candela interface 3; c++ abi 1002; libstdc++ cxx11";
    const fs::path directory =
        installed("interface_" + std::to_string(CANDELA_INTERFACE_VERSION) + ".so", before, "before");
    CHECK(refusal(directory) == expected(directory, before));
    CHECK(progress().empty());
}
