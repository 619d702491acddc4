// The requested scene: its files, and the values that override them.
module;

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

export module candela.scene:request;

export namespace candela {

/// A value given outside the files, which it overrides.
struct Setting {
    std::string origin;  // where it was given, for diagnostics: "--width"
    std::string path;    // "image.width", "light.lamp.intensity", "object.0.material.kd"
    std::string value;   // as it would be written in the file; bare words are strings
};

/// The name of a plugin given outside the files, which it overrides.
struct ModelSetting {
    std::string name;
    std::string origin{};  // as in Setting
};

struct SceneRequest {
    std::vector<std::filesystem::path> files;  // merged; none: the default scene
    /// The contents of those `files` that can be read only once, such as pipes, or that are text instead of
    /// files. Paths in them are relative to the working directory.
    std::map<std::filesystem::path, std::string> streams{};
    /// Replacements for the contents of files, by canonical path: edited, and not saved yet.
    std::map<std::filesystem::path, std::string> unsaved{};
    std::vector<Setting> settings;
    std::optional<ModelSetting> shading;                   // of every object
    std::optional<ModelSetting> reflection;                // of every object
    int frame = 0;                                         // of an animated scene
    bool use_defaults = false;                             // if no shading or reflection model is named
    std::function<bool(const std::string& question)> ask;  // called in that case instead of failing; may be
                                                           // empty
};

}  // namespace candela
