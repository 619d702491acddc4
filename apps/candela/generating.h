// What the verbs share that make programs from scenes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "command_line.h"
#include "targets.h"

import candela.render;

/// Adds --models.
void add_models_option(CommandLine& line);
/// Adds --approximate, which program_for() reads.
void add_approximate_option(CommandLine& line);

/// A scene that has passed all checks.
struct SceneToExport {
    std::string title;
    candela::Scene scene;
    candela::CompiledScene compiled;
    std::vector<std::filesystem::path> inputs;  // the files that it is made from
};
/// Nothing where there are errors, which are reported.
std::optional<SceneToExport> scene_to_export(const CommandLine& line, candela::Registry& registry,
                                             candela::Diagnostics& diagnostics);

/// What a target has of a scene. Throws candela::Error where it cannot express it.
candela::SceneExport export_for(const LoadedTarget& target, const SceneToExport& scene,
                                const CommandLine& line, candela::Registry& registry);

/// What the target makes of it. What it can only approximate is a warning with --approximate; without, throws
/// candela::Error (failure) that names all of it.
candela::ExportedProgram program_for(const LoadedTarget& target, const candela::SceneExport& exported,
                                     const CommandLine& line);

std::vector<std::filesystem::path> names_of(const std::vector<candela::ExportedFile>& files);

/// Throws candela::Error (bad_request) where a file of `names` in `folder`, which --`option` names, is one
/// that the scene is made from.
void require_no_input_in(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& names,
                         const SceneToExport& scene, const std::string& option);

/// Writes the files of a program to a folder, which is made where there is none: all of them, or none.
void write_program(const std::vector<candela::ExportedFile>& files, const std::filesystem::path& directory);
