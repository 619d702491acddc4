// Records what a frame's picture was made from, in a file next to it, so that it need not be rendered again.
#pragma once

#include <filesystem>
#include <map>
#include <string>

import candela.plugins;
import candela.render;
import candela.scene;
import candela.util;

/// Fingerprints of everything that determines a picture's bytes: the scene's values, the files it names, its
/// plugins' libraries, and Candela itself. Reads libraries and files once. One thread.
class InputFingerprints {
  public:
    InputFingerprints(candela::Registry& registry, const candela::OutputFormat& format);

    /// Makes all that follow depend on a text as well, and on a file if there is one of that name.
    void depend_on(const std::string& text, const std::filesystem::path& file);

    /// The fingerprint of one frame. Throws candela::Error (failure) if a file cannot be read.
    std::string of(const candela::SceneDraft& draft);

  private:
    const std::string& of_file(const std::filesystem::path& file);
    std::string of_plugin(candela::PluginKind kind, const std::string& name);

    candela::Registry& registry_;
    candela::OutputFormat format_;
    std::map<std::filesystem::path, std::string> files_;
    std::string further_;
};

/// The state of a picture according to its record and its size, without reading its contents.
enum class CacheState {
    missing,  // no picture or no record, or the picture's size has changed
    made,     // made from these inputs
    other     // made from other inputs
};
/// `links`: whether the picture may be a link, because the user chose its name.
CacheState recorded(const std::filesystem::path& image, const std::string& inputs, candela::Links links);

/// Like recorded(), for a picture whose name the user chose, whatever it was made from.
bool is_recorded(const std::filesystem::path& image);

/// Whether the picture is complete and was made from these inputs.
bool is_up_to_date(const std::filesystem::path& image, const std::string& inputs, candela::Links links);

/// Records what the picture was made from, in the folder .candela next to it. Throws candela::Error
/// (failure).
void record(const std::filesystem::path& image, const std::string& inputs, candela::Links links);
