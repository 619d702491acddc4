// Scenes from the files of other programs.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

import candela.registry;

namespace importing {

/// Whether a file is a model by its extension, which the shape `mesh` reads.
bool is_model(const std::filesystem::path& file);

enum class UpAxis { by_format, y, z };

struct Request {
    std::filesystem::path file;
    UpAxis up = UpAxis::by_format;
    bool allow_outside = false;  // whether the model may name files outside its folder
    bool with_animation = true;  // otherwise it is shown at rest
    /// How the scene is to name the model's file, which may be relative to the scene's.
    std::string shown_file;
    /// Puts a picture that the file contains where the scene can read it, and returns how the scene names it.
    std::function<std::string(const std::string& name, const std::string& content)> write_picture;
    /// How the scene names a picture that is there.
    std::function<std::string(const std::filesystem::path& file)> name_of_picture;
};

struct Imported {
    std::string scene;               // TOML
    std::vector<std::string> notes;  // what was lost or approximated: sentences without a full stop
    std::size_t objects = 0, lights = 0, textures = 0;
    /// While it exists, the model's triangles need not be read again. A plugin made it, so it must not
    /// outlive the registry.
    std::shared_ptr<const void> triangles{};
};

/// The scene that shows a model: its triangles, materials, textures, lights and its camera; what it does not
/// have is chosen so that all of it is seen. Throws candela::Error for a file that cannot be read.
Imported import_model(const Request& request, candela::Registry& registry);

}  // namespace importing
