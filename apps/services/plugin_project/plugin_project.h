// The files of a plugin's project.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene_export/exported_program.h"

import candela.plugins;
import candela.render;

/// A project's name in the forms that its files use.
struct ProjectNames {
    std::string name;   // "my-model"
    std::string ident;  // "my_model"
    std::string type;   // "MyModel"
    std::string title;  // "My model"
};
/// Throws candela::Error (bad_request) if `name` is not a valid plugin name.
ProjectNames project_names(const std::string& name);

/// The installed template of a kind, with the names filled in. Throws candela::Error (failure).
std::vector<candela::ExportedFile> template_files(const std::string& kind, const ProjectNames& names);

/// The title and the first sentence of a model that starts from another.
enum class Description { of_the_kernel, to_be_written };

/// The files of a model that differ from the template's: a kernel that declares what `model`'s does, with the
/// text and the identifiers of the new model. `model` is loaded. Throws candela::Error (bad_request) if the
/// text is not in the kernel language.
std::vector<candela::ExportedFile> files_like(const candela::PluginFile& model, const std::string& kernel,
                                              const ProjectNames& names, Description description);
