// Shared by the verbs that make programs from scenes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "scene_export/exported_program.h"
#include "scene_export/scene_export.h"
#include "verify/targets.h"

import candela.render;

/// Adds --models.
void add_models_option(CommandLine& line);
/// Adds --approximate, which program_for() reads.
void add_approximate_option(CommandLine& line);

/// A scene that passed all checks.
struct SceneToExport {
    std::string title;
    candela::Scene scene;
    candela::RenderScene compiled;
    std::vector<std::filesystem::path> inputs;  // the files the scene is made from
};
/// Nothing if there are errors, which are reported.
std::optional<SceneToExport> scene_to_export(const CommandLine& line, candela::Registry& registry,
                                             candela::Diagnostics& diagnostics);

/// The part of a scene that a target needs. Throws candela::Error if the target cannot express it.
candela::SceneExport export_for(const LoadedTarget& target, const SceneToExport& scene,
                                const CommandLine& line, candela::Registry& registry);

/// The program that the target makes of the scene. With --approximate, each approximation is a warning;
/// without it, throws candela::Error (failure) listing them all.
candela::ExportedProgram program_for(const LoadedTarget& target, const candela::SceneExport& exported,
                                     const CommandLine& line);

std::vector<std::filesystem::path> names_of(const std::vector<candela::ExportedFile>& files);

/// Throws candela::Error (bad_request) if one of the files `names` in `folder`, given by --`option`, is a
/// file that the scene is made from.
void require_no_input_in(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& names,
                         const SceneToExport& scene, const std::string& option);

/// Writes the files of a program to a folder, creating it if necessary: all of them, or none.
void write_program(const std::vector<candela::ExportedFile>& files, const std::filesystem::path& directory);
