// What a frame's picture was made from, written down beside it, so that it need not be made again.
#pragma once

#include <filesystem>
#include <map>
#include <string>

import candela.files;
import candela.film;
import candela.registry;
import candela.scene;

/// Fingerprints of all that decides the bytes of a picture: the scene's values, the files that it names, the
/// libraries of its plugins, and Candela itself. Libraries and files are read once. One thread.
class InputFingerprints {
  public:
    InputFingerprints(candela::Registry& registry, const candela::PictureFormat& format);

    /// Of one frame. Throws candela::Error (failure) if a file cannot be read.
    std::string of(const candela::SceneDraft& draft);

  private:
    const std::string& of_file(const std::filesystem::path& file);
    std::string of_plugin(candela::PluginKind kind, const std::string& name);

    candela::Registry& registry_;
    candela::PictureFormat format_;
    std::map<std::filesystem::path, std::string> files_;
};

/// What is said of a picture by its record, and by its size, without looking into it.
enum class Recorded {
    missing,  // the picture, or its record; or the picture has another size than it had
    made,     // from these inputs
    other     // made from others
};
/// `links`: whether the picture may be one, because a person chose its name.
Recorded recorded(const std::filesystem::path& picture, const std::string& inputs, candela::Links links);

/// The same of a picture whose name a person chose, whatever it was made from.
bool is_recorded(const std::filesystem::path& picture);

/// Whether the picture is whole, and was made from these inputs.
bool is_up_to_date(const std::filesystem::path& picture, const std::string& inputs, candela::Links links);

/// Writes down what the picture was made from, in the folder .candela beside it. Throws candela::Error
/// (failure).
void record(const std::filesystem::path& picture, const std::string& inputs, candela::Links links);
