// The files of a plugin's project.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

import candela.exported_scene;
import candela.registry;

/// A project's name in the forms that its files have it in.
struct ProjectNames {
    std::string name;   // "my-model"
    std::string ident;  // "my_model"
    std::string type;   // "MyModel"
    std::string title;  // "My model"
};
/// Throws candela::Error (bad_request) for what cannot be a plugin's name.
ProjectNames project_names(const std::string& name);

/// The installed template of a kind, with the names put in. Throws candela::Error (failure).
std::vector<candela::ExportedFile> template_files(const std::string& kind, const ProjectNames& names);

/// The files of a reflection model that differ from the template's: `model`'s parameters and relations, and
/// the kernel text, in which what is called after `model` is called after the new one. `model` is loaded.
/// Throws candela::Error (bad_request) for a model whose parameters a text cannot hold.
std::vector<candela::ExportedFile> files_like(const candela::PluginFile& model, const std::string& kernel,
                                              const ProjectNames& names);
