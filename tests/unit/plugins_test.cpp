#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "console/diagnostics_text.h"
#include "support/command.h"
#include "support/expect.h"
#include "support/plugins.h"
#include "support/scene_tables.h"
#include "support/text.h"

namespace fs = std::filesystem;
using candela::PluginKind;
using candela::Registry;

namespace {

const fs::path k_libraries = CANDELA_TEST_LIBRARIES;
const fs::path k_shipped = CANDELA_TEST_PLUGINS;
const fs::path k_plugins = fs::path(CANDELA_TEST_SOURCE) / "plugins";

/// A directory with `library` as reflection-NAME.so, and the manifest of Phong with that name.
fs::path directory_with(const fs::path& library, const std::string& name) {
    const fs::path directory = scratch_directory();
    fs::copy_file(library, directory / ("reflection-" + name + ".so"));
    candela::Manifest manifest = test_registry().require(PluginKind::reflection, "phong").manifest;
    manifest.name = name;
    write_file(directory / ("reflection-" + name + ".json"), candela::to_json(manifest));
    return directory;
}

/// The message with which an instance of the model is refused; everything else must still work.
std::string refusal(const fs::path& directory, const std::string& name) {
    Registry registry({directory, k_shipped});
    const std::string sentence = message_of<candela::Error>([&] {
        registry.create<candela::ReflectionModel>(name, registry.parameters(PluginKind::reflection, name),
                                                  candela::ColorEncoding::none);
    });
    CHECK(registry.find(PluginKind::reflection, "phong") != nullptr);
    CHECK(sentence.find('\n') == std::string::npos);
    return sentence;
}

/// The plugins of the source tree, by kind and name: a plugin is a kernel file or a folder.
std::vector<std::string> sources() {
    std::vector<std::string> ids;
    for (const char* const kind : {"light", "reflection", "shading", "shape", "image", "target"}) {
        std::vector<std::string> of_kind;
        for (const auto& entry : fs::directory_iterator(k_plugins / kind)) {
            if (entry.is_directory() || entry.path().extension() == ".kernel")
                of_kind.push_back(kind + ("/" + entry.path().stem().string()));
        }
        std::ranges::sort(of_kind);
        ids.insert(ids.end(), of_kind.begin(), of_kind.end());
    }
    return ids;
}

}  // namespace

TEST_CASE("the shipped plugins are all listed, with their manifests and without refusals") {
    Registry registry({k_shipped});
    std::vector<std::string> ids;
    for (const candela::PluginFile* file : registry.list()) {
        ids.push_back(file->manifest.id());
        CHECK_FALSE(file->manifest.title.empty());
        CHECK_FALSE(file->manifest.summary.empty());
        CHECK(file->manifest.abi == candela::host_abi());
        for (const candela::Parameter& p : file->manifest.parameters) CHECK_FALSE(p.meaning.empty());
    }
    CHECK(ids == sources());
    CHECK(registry.refusals().empty());
}

TEST_CASE("every shipped plugin agrees with its manifest, and every default fits its range") {
    Registry registry({k_shipped});
    for (const candela::PluginFile* file : registry.list()) {
        INFO(file->manifest.id());
        CHECK_NOTHROW(candela::load_plugin(file->library, &file->manifest));
        for (const candela::Parameter& p : file->manifest.parameters) {
            if (p.default_value) CHECK_FALSE(candela::validation_error(p, *p.default_value));
        }
        const candela::ParamSet defaults(file->manifest.parameters);
        for (const candela::Relation& r : file->manifest.relations)
            CHECK_FALSE(candela::validation_error(r, defaults));
    }
}

TEST_CASE("a plugin made of kernel functions includes their text, and declares how to call them") {
    Registry registry({k_shipped});
    for (const candela::PluginFile* file : registry.list()) {
        const candela::Manifest& m = file->manifest;
        INFO(m.id());
        const candela::KernelText& kernel = candela::load_plugin(file->library, &m).kernel;
        CHECK(m.has_kernel == (kernel.text != nullptr));
        fs::path source = k_plugins / candela::name_of(m.kind) / (m.name + ".kernel");
        if (!fs::exists(source)) source = source.parent_path() / m.name / (m.name + ".kernel");
        CHECK(m.has_kernel == fs::exists(source));
        if (!m.has_kernel) continue;
        const std::string text = kernel.text;
        CHECK(text == read_file(source));
        CHECK(holds(text, "KERNEL"));
        CHECK(holds(text, " " + m.kernel_prefix + "_"));
        CHECK(m.kernel_parameters.empty() == m.parameters.empty());
        // The struct's members have the parameters' names.
        if (!m.kernel_parameters.empty()) CHECK(holds(text, "struct " + m.kernel_parameters + " {"));
        for (const candela::Parameter& p : m.parameters) CHECK(holds(text, " " + p.name + ";"));
    }
}

TEST_CASE("the first directory of the search path wins") {
    const fs::path first = directory_with(k_shipped / "reflection-phong.so", "phong");
    Registry registry({first, k_shipped});
    CHECK(registry.require(PluginKind::reflection, "phong").library.parent_path() == first);
    CHECK(registry.require(PluginKind::reflection, "lambert").library.parent_path() == k_shipped);
}

TEST_CASE("the search path is --plugin-dir, CANDELA_PLUGIN_PATH, the user's data, the install") {
    ::setenv("CANDELA_PLUGIN_PATH", "/a::/b", 1);
    ::setenv("XDG_DATA_HOME", "/data", 1);
    const std::vector<fs::path> first = {"/first"};
    const auto path = candela::plugin_search_path(first);
    ::unsetenv("CANDELA_PLUGIN_PATH");
    ::unsetenv("XDG_DATA_HOME");
    REQUIRE(path.size() == 5);
    CHECK(path[0] == "/first");
    CHECK(path[1] == "/a");
    CHECK(path[2] == "/b");
    CHECK(path[3] == "/data/candela/plugins");
    CHECK(fs::weakly_canonical(path[4]) == fs::weakly_canonical(k_shipped));
}

TEST_CASE("the message on an unknown name lists what is installed and suggests the nearest") {
    Registry registry({k_shipped});
    const std::string sentence =
        message_of<candela::Error>([&] { registry.require(PluginKind::reflection, "blin-phong"); });
    CHECK(holds(sentence, "no reflection plugin is called 'blin-phong'"));
    CHECK(holds(sentence, "did you mean 'blinn-phong'?"));
    CHECK(holds(sentence, "half-lambert"));
    CHECK(registry.find(PluginKind::reflection, "../shape/cube") == nullptr);
}

TEST_CASE("a library with a wrong fingerprint is refused before any of it is called") {
    CHECK(holds(refusal(directory_with(k_libraries / "old_abi.so", "old"), "old"),
                "it was built for 'candela interface 0;"));
}

TEST_CASE("a manifest with a wrong fingerprint is refused before the library is loaded") {
    const fs::path directory = scratch_directory();
    candela::Manifest manifest = test_registry().require(PluginKind::reflection, "phong").manifest;
    manifest.name = "newer";
    manifest.abi = "candela interface 99; c++ abi 1002; libstdc++ cxx11";
    write_file(directory / "reflection-newer.json", candela::to_json(manifest));
    write_file(directory / "reflection-newer.so", "never opened");
    const std::string sentence = refusal(directory, "newer");
    CHECK(holds(sentence, "it was built for 'candela interface 99;"));
    CHECK(holds(sentence, "build it again with this Candela's SDK"));
}

TEST_CASE("a library without an entry point is refused") {
    CHECK(holds(refusal(directory_with(k_libraries / "no_entry.so", "none"), "none"),
                "does not export candela_plugin_abi"));
}

TEST_CASE("a library with an unresolved symbol is refused, naming the symbol") {
    CHECK(holds(refusal(directory_with(k_libraries / "missing_symbol.so", "needy"), "needy"),
                "candela_test_nobody_has_this"));
}

TEST_CASE("a text file named .so is refused") {
    const fs::path text = write_file(scratch_directory().parent_path() / "text.so", "I am a text.\n");
    CHECK(holds(refusal(directory_with(text, "text"), "text"), "cannot be loaded"));
}

TEST_CASE("a manifest that disagrees with its library is refused, naming the parts that differ") {
    const fs::path directory = directory_with(k_shipped / "reflection-phong.so", "phong");
    candela::Manifest manifest = test_registry().require(PluginKind::reflection, "phong").manifest;
    manifest.parameters[3].default_value = 33.0;
    manifest.title = "Fong";
    manifest.surface_needs.uv = true;
    write_file(directory / "reflection-phong.json", candela::to_json(manifest));
    CHECK(holds(refusal(directory, "phong"),
                "its manifest disagrees with it about its title, parameters, needs"));
}

TEST_CASE("what a model reads is in its manifest, and what it offers is its class") {
    const auto manifest = [](PluginKind kind, std::string_view name) -> const candela::Manifest& {
        return test_registry().require(kind, name).manifest;
    };
    CHECK(manifest(PluginKind::light, "hemisphere").has_ambient);
    CHECK_FALSE(manifest(PluginKind::light, "point").has_ambient);
    CHECK(
        (manifest(PluginKind::reflection, "phong").surface_needs == candela::SurfaceNeeds{.varying = true}));
    CHECK((manifest(PluginKind::reflection, "ward").surface_needs ==
           candela::SurfaceNeeds{.tangent = true, .varying = true}));
    CHECK(manifest(PluginKind::shading, "gouraud").shading_needs.default_vertex_normals);
    CHECK_FALSE(manifest(PluginKind::shading, "area-weighted").shading_needs.default_vertex_normals);

    const auto offers = []<class Extension, class Interface>(std::string_view name, Given given = {}) {
        return candela::extension_of<Extension>(*instance<Interface>(name, given)) != nullptr;
    };
    using candela::Light, candela::ReflectionModel;
    CHECK(offers.operator()<candela::PunctualSource, Light>("point", {{"position", candela::Vec3{}}}));
    CHECK_FALSE(offers.operator()<candela::PunctualSource, Light>("ambient"));
    CHECK(offers.operator()<candela::UniformAmbientSource, Light>("ambient"));
    CHECK_FALSE(offers.operator()<candela::UniformAmbientSource, Light>("hemisphere"));
    CHECK(offers.operator()<candela::AllLightsReflection, ReflectionModel>("phong"));
    CHECK_FALSE(offers.operator()<candela::EnvironmentReflection, ReflectionModel>("phong"));
    CHECK(offers.operator()<candela::EnvironmentReflection, ReflectionModel>("dielectric"));
}

TEST_CASE("a plugin's manifest must be next to it, valid, and its own") {
    const fs::path directory = scratch_directory();
    fs::copy_file(k_shipped / "reflection-phong.so", directory / "reflection-alone.so");
    fs::copy_file(k_shipped / "reflection-phong.so", directory / "reflection-junk.so");
    write_file(directory / "reflection-junk.json", "{]");
    fs::copy_file(k_shipped / "reflection-phong.so", directory / "reflection-other.so");
    fs::copy_file(k_shipped / "reflection-phong.json", directory / "reflection-other.json");
    fs::copy_file(k_shipped / "reflection-phong.json", directory / "reflection-bare.json");
    CHECK(holds(refusal(directory, "alone"), "reflection-alone.json is missing"));
    CHECK(holds(refusal(directory, "junk"), "it is not a manifest"));
    CHECK(holds(refusal(directory, "other"), "its manifest is that of reflection/phong"));
    CHECK(holds(refusal(directory, "bare"), "its manifest exists, but the library does not"));
    Registry registry({directory, k_shipped});
    CHECK(registry.list().size() == sources().size());
    CHECK(registry.refusals().size() == 4);
}

TEST_CASE("only the manifests of the requested kind are read") {
    const fs::path directory = scratch_directory();
    fs::copy_file(k_shipped / "light-point.so", directory / "light-junk.so");
    write_file(directory / "light-junk.json", "{]");
    Registry registry({directory, k_shipped});
    const auto shipped =
        std::ranges::count_if(fs::directory_iterator(k_shipped), [](const fs::directory_entry& entry) {
            return entry.path().filename().string().starts_with("image-") &&
                   entry.path().extension() == ".json";
        });
    CHECK(std::cmp_equal(registry.list(PluginKind::image).size(), shipped));
    CHECK(registry.find_format("ppm") != nullptr);
    CHECK(registry.refusals().empty());
    CHECK(registry.list(PluginKind::light).front()->manifest.name == "ambient");
    CHECK(registry.refusals().size() == 1);
}

TEST_CASE("a manifest of more than a mebibyte is refused") {
    const fs::path directory = scratch_directory();
    fs::copy_file(k_shipped / "light-point.so", directory / "light-point.so");
    candela::Manifest manifest = test_registry().require(PluginKind::light, "point").manifest;
    const auto refused_with_size = [&](std::size_t size) {
        std::string text = candela::to_json(manifest);
        text.append(size - text.size(), '\n');
        write_file(directory / "light-point.json", text);
        Registry registry({directory});
        return registry.find(PluginKind::light, "point") == nullptr &&
               holds(registry.refusals().at(0).reason, "is larger than 1048576 bytes");
    };
    CHECK_FALSE(refused_with_size(std::size_t{1} << 20));
    CHECK(refused_with_size((std::size_t{1} << 20) + 1));
}

TEST_CASE("a plugin's exception becomes an error that names the plugin") {
    Registry registry({k_libraries, k_shipped});
    candela::ParamSet values = registry.parameters(PluginKind::reflection, "throwing");
    values.set("kd", 0.0);
    CHECK(message_of<candela::Error>([&] {
              registry.create<candela::ReflectionModel>("throwing", values, candela::ColorEncoding::none);
          }) == "plugin reflection/throwing: no model without light");

    for (const char* const light : {"point", "ambient"}) {
        candela::SceneRequest request;
        request.reflection = {"throwing"};
        request.settings = {{"--set", "light.0.type", light}};
        candela::Diagnostics diagnostics;
        // The default scene's point light has parameters that an ambient light does not.
        const bool is_point = std::string(light) == "point";
        if (!is_point) {
            request.settings.clear();
            request.files = {write_file(
                scratch_directory() / "scene.toml",
                k_start + "[shading]\nmodel = \"phong\"\n[[light]]\ntype = \"ambient\"\n" + k_cube)};
        }
        const auto scene = candela::read_scene(request, registry, diagnostics);
        INFO(diagnostics_text(diagnostics, false));
        REQUIRE(scene);
        const auto compiled = candela::build(*scene, registry, diagnostics);
        REQUIRE(compiled);
        candela::Film film(64, 64, candela::PixelType::byte, candela::ColorEncoding::srgb);
        for (const int threads : {1, 4}) {
            const std::string sentence =
                message_of<candela::Error>([&] { candela::render(*compiled, film, {.threads = threads}); });
            CHECK(sentence ==
                  (is_point ? "plugin reflection/throwing: out of photons"
                            : "plugin reflection/throwing threw an object that is not a std::exception"));
        }
    }
}

TEST_CASE("only what a scene names is loaded") {
    const CommandResult traced =
        succeeded(run_candela({"render", "-o", (scratch_directory() / "a.png").string()},
                              {.environment = {{"LD_DEBUG", "files"}}}));
    for (const char* const unused :
         {"OpenImageIO", "shape-mesh", "half-lambert", "gouraud", "teapot", "spot"}) {
        CHECK_FALSE(holds(traced.err, unused));
    }
    CHECK(holds(traced.err, "reflection-phong.so"));
}

TEST_CASE("a format's own plugin is preferred to one for all formats") {
    Registry registry({k_shipped});
    CHECK(registry.find_format("png")->manifest.name == "png");
    CHECK(registry.find_format("ppm")->manifest.name == "pnm");
    CHECK(registry.find_format("pfm")->manifest.name == "pnm");
    CHECK(registry.find_format("exr")->manifest.name == "openimageio");
    CHECK(registry.find_format("doc") == nullptr);
}
