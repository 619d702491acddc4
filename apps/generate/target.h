// What can be generated from a scene.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "exported_scene.h"
#include "text_template.h"

import candela.core;

namespace generate {

struct GeneratedFile {
    std::string name;
    std::string text;
};

/// A kind of program.
struct Target {
    const char* name;
    const char* summary;
    const char* shows;  // the file that a person opens or runs once it is built
    std::vector<GeneratedFile> (*generate)(const ExportedScene& scene, const Templates& templates,
                                           candela::Registry& registry);
};

std::vector<GeneratedFile> cpp_program(const ExportedScene& scene, const Templates& templates,
                                       candela::Registry& registry);
std::vector<GeneratedFile> opengl_program(const ExportedScene& scene, const Templates& templates,
                                          candela::Registry& registry);
std::vector<GeneratedFile> webgl_page(const ExportedScene& scene, const Templates& templates,
                                      candela::Registry& registry);

std::span<const Target> targets();
/// Throws candela::Error (usage) with a suggestion.
const Target& target_called(const std::string& name);

}  // namespace generate
