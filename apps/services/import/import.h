// Makes scenes from the files of other programs.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

import candela.plugins;

namespace importing {

/// Whether a file is, by its extension, a model that the shape `mesh` reads.
bool is_model(const std::filesystem::path& file);

enum class UpAxis { by_format, y, z };

struct Request {
    std::filesystem::path file;
    UpAxis up = UpAxis::by_format;
    bool allow_outside = false;  // whether the model may name files outside its folder
    bool with_animation = true;  // otherwise it is shown at rest
    bool with_studio = true;     // lights a model without lights; otherwise, a key and a fill light do
    /// The model's file name in the scene; may be relative to the scene's folder.
    std::string shown_file;
    /// Writes a picture embedded in the file to a place that the scene can read, and returns its name in the
    /// scene.
    std::function<std::string(const std::string& name, const std::string& content)> write_image;
    /// The name, in the scene, of an existing picture.
    std::function<std::string(const std::filesystem::path& file)> name_of_image;
};

struct Imported {
    std::string scene;               // TOML
    std::vector<std::string> notes;  // losses and approximations: sentences without a full stop
    std::size_t objects = 0, lights = 0, textures = 0;
    /// While this exists, the model's triangles need not be read again. A plugin made it, so it must not
    /// outlive the registry.
    std::shared_ptr<const void> triangles{};
};

/// The scene that shows a model: its triangles, materials, textures, lights and camera. Anything it lacks is
/// chosen so that all of the model is visible. Throws candela::Error for a file that cannot be read.
Imported import_model(const Request& request, candela::Registry& registry);

}  // namespace importing
