#include "cli/model_scene.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "console/reporting.h"
#include "import/import.h"
#include "sandbox/temporary_folder.h"

import candela.api;
import candela.util;

namespace {

/// Readers that read each model's triangles only once. Never destroyed: the plugins are gone by then.
std::vector<std::shared_ptr<const void>>& triangles_of_models() {
    static auto& all =
        *new std::vector<std::shared_ptr<const void>>;  // NOLINT(cppcoreguidelines-owning-memory)
    return all;
}

}  // namespace

void expect_models() {}

const std::string& scene_of_model(const std::string& file, const ModelOptions& options,
                                  candela::Registry& registry) {
    static std::map<std::string, std::string> known;
    static std::optional<TemporaryFolder> images;
    const auto [scene, is_new] = known.try_emplace(file);
    if (!is_new) return scene->second;
    const importing::Request request{
        .file = file,
        .allow_outside = options.allow_outside,
        .with_animation = options.with_animation,
        .with_studio = options.with_studio,
        .shown_file = std::filesystem::path(file).filename().string(),  // it is relative to itself
        .write_image =
            [&](const std::string& name, const std::string& content) {
                if (!images) images.emplace("candela-import-");
                const std::filesystem::path path = images->path() / name;
                candela::write_text_file(path, content);
                return path.string();
            },
        .name_of_image = [](const std::filesystem::path& image) { return image.string(); }};
    importing::Imported imported;
    candela::with_threads(options.threads, [&] { imported = importing::import_model(request, registry); });
    for (const std::string& note : imported.notes) warn(note);
    triangles_of_models().push_back(imported.triangles);
    return scene->second = imported.scene;
}

void forget_triangles_of_models() { triangles_of_models().clear(); }
