// Targets as used by the verbs.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "scene_export/exported_program.h"

import candela.plugins;
import candela.render;
import candela.util;

/// A target whose plugin is loaded. Exceptions of the plugin become candela::Error with its name.
class LoadedTarget {
  public:
    /// Throws candela::Error (usage), with a suggestion, for an unknown target.
    LoadedTarget(const std::string& name, candela::Registry& registry);

    const std::string& name() const { return name_; }
    candela::TargetAbilities abilities() const { return target_->abilities(); }
    bool can_draw() const { return target_->can_draw(); }
    /// The name of the file to open first.
    std::string main_file() const { return target_->main_file(); }

    candela::ExportedProgram program_of(const candela::ExportedScene& scene) const {
        return candela::program_of(*target_, name_, scene);
    }
    void build(const std::filesystem::path& directory) const;
    void draw(const std::filesystem::path& directory, const std::filesystem::path& image) const;
    /// Returns an exit code.
    int show(const std::filesystem::path& directory) const;

  private:
    std::string name_;
    std::unique_ptr<candela::Target> target_;
};

/// The first target, by name, whose main file is an HTML page. Throws candela::Error (failure) if there is
/// none.
LoadedTarget page_target(candela::Registry& registry);

/// "cpp, opengl, webgl": the installed targets, `last` between the last two.
std::string target_names(candela::Registry& registry, const std::string& last = ", ");

/// A line for each installed target: its name and summary.
std::string target_summaries(candela::Registry& registry);
