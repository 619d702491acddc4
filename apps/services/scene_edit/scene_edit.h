// Changes of a scene, written into its files.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

import candela.plugins;
import candela.scene;
import candela.util;

namespace candela {

/// A file's text as it was read, and its replacement.
struct TextChange {
    std::filesystem::path file;
    std::string before, after;
};

/// The texts of those files of a scene that `changes` modify, with the changes applied: values are replaced
/// in place or added to their tables; comments, order and everything else stay. The files are not touched.
/// Reports what is wrong with the scene or the changes, and then returns nothing. Throws Error (bad_request)
/// if the changed files would yield a different scene than `request` with `changes` in its settings, for
/// example because a setting or an object's own model prevails.
std::vector<TextChange> edited_files(const SceneRequest& request, const std::vector<Setting>& changes,
                                     Registry& registry, Diagnostics& diagnostics);

/// Replaces texts, all or none: if a file no longer contains the text that was read, because another program
/// has saved it meanwhile, nothing is written. Throws Error (failure).
void replace_texts(std::span<const TextChange> changes);

}  // namespace candela
