// Requirements for targets.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "candela/kernel_language/declarations.h"
#include "sandbox/temporary_folder.h"
#include "scene_export/exported_program.h"
#include "scene_export/scene_export.h"
#include "scene_export/system_programs.h"
#include "subject.h"

import candela.plugins;
import candela.render;
import candela.scene;
import candela.util;

namespace fs = std::filesystem;
using candela::ExportedFile;
using candela::PluginKind;
using candela::Target;

namespace {

constexpr const char* k_head =
    "version = 1\n[observer]\nposition = [0, 0, 4]\nlook_at = [0, 0, 0]\n"
    "[shading]\nmodel = \"phong\"\n[reflection]\nmodel = \"phong\"\n";

std::vector<fs::path> search_path() {
    return candela::plugin_search_path(std::vector{subject_library().parent_path()});
}

/// A scene, checked and exported for a target.
class Exported {
  public:
    /// Empty text: the default scene.
    explicit Exported(const Target& target, const std::string& text = {},
                      const std::string& title = "A scene")
        : registry_(search_path()) {
        candela::SceneRequest request;
        request.settings = {{"--width", "image.width", "64"}, {"--height", "image.height", "48"}};
        if (!text.empty()) {
            request.files = {folder_.path() / "scene.toml"};
            std::ofstream(request.files.front(), std::ios::binary) << text;
        }
        candela::Diagnostics diagnostics;
        const auto scene = candela::read_scene(request, registry_, diagnostics);
        if (!scene) FAIL("the scene cannot be read: " << diagnostics.sorted().front().message);
        try {
            export_.emplace(*scene, candela::ExportRequest{.title = title, .abilities = target.abilities()},
                            registry_);
        } catch (const candela::Error& problem) {
            SKIP("the default scene's plugins are not installed: " << problem.what());
        }
    }
    const candela::ExportedScene& scene() const { return export_->scene(); }

  private:
    TemporaryFolder folder_{"candela-target-"};
    candela::Registry registry_;
    std::optional<candela::SceneExport> export_;
};

std::vector<ExportedFile> files_of(const Target& target, const Exported& exported) {
    return candela::program_of(target, subject_manifest().name, exported.scene()).files;
}

bool are_equal(const std::vector<ExportedFile>& a, const std::vector<ExportedFile>& b) {
    return std::ranges::equal(a, b, [](const ExportedFile& x, const ExportedFile& y) {
        return x.name == y.name && x.content == y.content;
    });
}

/// Writes a scene, or refuses it with an exception; anything else ends the process.
void write_or_refuse(const Target& target, const Exported& exported, const std::string& what) {
    try {
        for (const ExportedFile& file : files_of(target, exported)) {
            if (std::ranges::any_of(file.name, [](char c) { return static_cast<unsigned char>(c) < ' '; }))
                FAIL("of " << what << " it creates a file with control characters in its name");
        }
    } catch (const candela::Error& refusal) {
        WARN("it refuses " << what << ": " << refusal.what());
    }
}

/// The models that it declares to express exactly.
std::vector<std::string> exact_models(PluginKind kind) {
    const std::string names = declared(fmt::format("exact-{}", candela::name_of(kind)));
    return names.empty() ? std::vector<std::string>() : candela::kernel_language::property_names(names);
}

/// A light with its required parameters, as TOML.
std::string light_text(const candela::PluginFile& light) {
    std::string text = fmt::format("[[light]]\ntype = \"{}\"\n", light.manifest.name);
    for (const candela::Parameter& p : light.manifest.parameters) {
        if (p.default_value) continue;
        if (p.type == candela::ParamType::point) text += fmt::format("{} = [0, 3, 2]\n", p.name);
        if (p.type == candela::ParamType::direction) text += fmt::format("{} = [0, -3, -2]\n", p.name);
    }
    return text;
}

/// A disk that is full from the start.
class FullDisk final : public candela::FileSink {
  public:
    void write(const char*, std::span<const std::byte>) override {
        throw std::runtime_error("the disk is full");
    }
};

}  // namespace

TEST_CASE("files: the default scene becomes files, including the main one, named within their folder",
          "[target]") {
    const auto target = make<Target>(default_values());
    const Exported exported(*target);
    std::vector<ExportedFile> files;
    try {
        files = files_of(*target, exported);
    } catch (const candela::Error& problem) {
        FAIL("the default scene is refused: " << problem.what());
    }
    if (std::ranges::find(files, target->main_file(), &ExportedFile::name) == files.end())
        FAIL_CHECK("its main file, '" << target->main_file() << "', is not among those that it writes");
    for (const ExportedFile& file : files) {
        if (file.content.empty()) FAIL_CHECK("the file '" << file.name << "' is empty");
    }
}

TEST_CASE("determinism: one scene becomes the same files every time", "[target]") {
    const auto target = make<Target>(default_values()), other = make<Target>(default_values());
    const Exported exported(*target), again(*target);
    const std::vector<ExportedFile> files = files_of(*target, exported);
    if (!are_equal(files, files_of(*target, exported))) FAIL("written twice, the files differ");
    if (!are_equal(files, files_of(*other, again))) FAIL("another instance writes other files");
}

TEST_CASE("odd scenes: without lights, without objects, with hostile names, it writes or refuses them",
          "[target]") {
    const auto target = make<Target>(default_values());
    const std::string light = "[[light]]\ntype = \"point\"\nposition = [0, 2, 2]\n";
    const std::string object = "[[object]]\ntype = \"cube\"\n";
    write_or_refuse(*target, Exported(*target, k_head), "an empty scene");
    write_or_refuse(*target, Exported(*target, k_head + light), "a scene without objects");
    write_or_refuse(*target, Exported(*target, k_head + object), "a scene without lights");
    const std::string name = R"(name = "*/ \" ' \\ </script> ../.. \n @TITLE@ \u202e"
)";
    write_or_refuse(*target,
                    Exported(*target, k_head + light + name + object + name, "../*/\"</script>\n@TITLE@\\"),
                    "hostile names");
}

TEST_CASE("exact models: it does not approximate those that it declares to express exactly", "[target]") {
    constexpr PluginKind k_kinds[] = {PluginKind::light, PluginKind::reflection, PluginKind::shading};
    const auto target = make<Target>(default_values());
    candela::Registry registry(search_path());
    std::map<PluginKind, std::string> usual = {
        {PluginKind::light, "point"}, {PluginKind::reflection, "phong"}, {PluginKind::shading, "phong"}};
    for (const PluginKind kind : k_kinds) {
        if (const auto names = exact_models(kind); !names.empty()) usual[kind] = names.front();
    }
    for (const PluginKind kind : k_kinds) {
        for (const std::string& name : exact_models(kind)) {
            std::map<PluginKind, std::string> models = usual;
            models[kind] = name;
            const auto is_missing = [&](const auto& model) {
                return registry.find(model.first, model.second) == nullptr;
            };
            if (std::ranges::any_of(models, is_missing)) {
                WARN("not everything is installed that a scene with " << name << " needs");
                continue;
            }
            const Exported exported(
                *target, fmt::format("version = 1\n[observer]\nposition = [0, 0, 4]\nlook_at = [0, 0, 0]\n"
                                     "{}[[object]]\ntype = \"cube\"\nshading = \"{}\"\nreflection = \"{}\"\n",
                                     light_text(*registry.find(PluginKind::light, models[PluginKind::light])),
                                     models[PluginKind::shading], models[PluginKind::reflection]));
            const auto program = candela::program_of(*target, subject_manifest().name, exported.scene());
            for (const std::string& sentence : program.approximations)
                FAIL_CHECK("it declares " << candela::name_of(kind) << "/" << name
                                          << " to be exact, but approximates: " << sentence);
        }
    }
}

TEST_CASE("full disk: exceptions of the host while files are written come out of write()", "[target]") {
    const auto target = make<Target>(default_values());
    const Exported exported(*target);
    FullDisk disk;
    bool says_so = false;
    try {
        target->write(exported.scene(), disk);
    } catch (const std::exception&) {
        says_so = true;
    }
    if (!says_so) FAIL("the disk is full, but it reports nothing");
}

TEST_CASE("files of its own: writing leaves none in the working directory", "[target]") {
    const auto target = make<Target>(default_values());
    const Exported exported(*target);
    const TemporaryFolder folder("candela-target-");
    fs::current_path(folder.path());
    files_of(*target, exported);
    std::string left;
    for (const auto& entry : fs::directory_iterator(folder.path()))
        left += " " + entry.path().filename().string();
    fs::current_path("/");
    if (!left.empty()) FAIL("it left in the working directory:" << left);
}

TEST_CASE("picture: what it writes can be built, and draws a picture of the image's size", "[target]") {
    const auto target = make<Target>(default_values());
    if (!target->can_draw()) SKIP("it draws no pictures");
    const Exported exported(*target);
    const TemporaryFolder folder("candela-target-");
    for (const ExportedFile& file : files_of(*target, exported)) {
        fs::create_directories((folder.path() / file.name).parent_path());
        candela::write_text_file(folder.path() / file.name, file.content);
    }
    candela::SystemPrograms programs;
    const fs::path picture = folder.path() / "picture.png";
    try {
        target->build(folder.path().c_str(), programs);
        target->draw(folder.path().c_str(), picture.c_str(), programs);
    } catch (const std::exception& problem) {
        WARN("this machine cannot draw the picture: " << problem.what());
        return;
    }
    std::ifstream file(picture, std::ios::binary);
    std::string head(24, '\0');
    if (!file.read(head.data(), 24) || !head.starts_with("\x89PNG")) FAIL("it does not draw a PNG file");
    const auto number_at = [&](std::size_t at) {
        int number = 0;
        for (std::size_t i = at; i < at + 4; ++i) number = number << 8 | static_cast<unsigned char>(head[i]);
        return number;
    };
    const auto& image = exported.scene().image;
    if (number_at(16) != image.width || number_at(20) != image.height)
        FAIL(fmt::format("its picture has {} x {} pixels, but the image has {} x {}", number_at(16),
                         number_at(20), image.width, image.height));
}
