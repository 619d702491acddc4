// What the verbs share that make programs from scenes.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "command_line.h"
#include "generate/exported_scene.h"
#include "generate/target.h"

import candela.core;

/// Adds --models.
void add_models_option(CommandLine& line);

/// A scene that has passed all checks, and what a program has of it.
struct SceneToExport {
    candela::CompiledScene compiled;
    generate::ExportedScene exported;
};
/// Nothing where there are errors, which are reported. Throws candela::Error where a program cannot have the
/// scene.
std::optional<SceneToExport> scene_to_export(const CommandLine& line, candela::Registry& registry,
                                             candela::Diagnostics& diagnostics);

/// The installed templates.
generate::Templates generate_templates();

/// Writes the files of a program to a folder, which is made where there is none. Each is whole or not there.
void write_program(const std::vector<generate::GeneratedFile>& files, const std::filesystem::path& directory);
