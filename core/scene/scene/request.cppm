// Which scene is wanted: its files, and what is said beside them.
module;

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

export module candela.scene:request;

export namespace candela {

/// A value given beside the files; it overrides what they say.
struct Setting {
    std::string origin;  // who says so, for diagnostics: "--width"
    std::string path;    // "image.width", "light.lamp.intensity", "object.0.material.kd"
    std::string value;   // as it would be written in the file; bare words are strings
};

/// The name of a plugin given beside the files; it overrides what they say.
struct ModelSetting {
    std::string name;
    std::string origin{};  // as in Setting
};

struct SceneRequest {
    std::vector<std::filesystem::path> files;  // merged; none: the default scene
    /// The contents of those among `files` that can only be read once, such as pipes, or that are no files
    /// but text. Paths in them are relative to the working directory.
    std::map<std::filesystem::path, std::string> streams{};
    /// What stands for the contents of a file, by its canonical path: edited, and not saved yet.
    std::map<std::filesystem::path, std::string> unsaved{};
    std::vector<Setting> settings;
    std::optional<ModelSetting> shading;                   // of every object
    std::optional<ModelSetting> reflection;                // likewise
    int frame = 0;                                         // of an animated scene
    bool use_defaults = false;                             // if no shading or reflection model is named
    std::function<bool(const std::string& question)> ask;  // called instead of failing then; may be empty
};

}  // namespace candela
