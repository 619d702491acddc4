#include "verify/targets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scene_export/system_programs.h"

import candela.plugins;
import candela.util;

using candela::Error;
using candela::ErrorCategory;
using candela::PluginKind;
namespace fs = std::filesystem;

LoadedTarget::LoadedTarget(const std::string& name, candela::Registry& registry) : name_(name) {
    if (registry.find(PluginKind::target, name) == nullptr) {
        const std::string stem = "target-" + name;
        for (const candela::Refusal& refused : registry.refusals()) {
            if (refused.file.stem() == stem)
                throw Error(ErrorCategory::failure, refused.reason, refused.help);
        }
        const std::string meant = candela::suggestion(name, registry.names(PluginKind::target));
        throw Error(ErrorCategory::bad_request,
                    fmt::format("unknown target '{}'{} (possible: {})", name,
                                meant.empty() ? "" : "; " + meant, target_names(registry)));
    }
    target_ = registry.create<candela::Target>(name, registry.parameters(PluginKind::target, name),
                                               candela::ColorEncoding::none);
}

void LoadedTarget::build(const fs::path& directory) const try {
    candela::SystemPrograms programs;
    target_->build(directory.c_str(), programs);
} catch (...) {
    candela::rethrow_as_plugin_error(PluginKind::target, name_);
}

void LoadedTarget::draw(const fs::path& directory, const fs::path& image) const try {
    candela::SystemPrograms programs;
    target_->draw(directory.c_str(), image.c_str(), programs);
} catch (...) {
    candela::rethrow_as_plugin_error(PluginKind::target, name_);
}

int LoadedTarget::show(const fs::path& directory) const try {
    candela::SystemPrograms programs;
    return target_->show(directory.c_str(), programs);
} catch (...) {
    candela::rethrow_as_plugin_error(PluginKind::target, name_);
}

LoadedTarget page_target(candela::Registry& registry) {
    for (const std::string& name : registry.names(PluginKind::target)) {
        LoadedTarget target(name, registry);
        // Pages made from kernels can be edited.
        if (fs::path(target.main_file()).extension() == ".html" && !target.abilities().models_without_kernel)
            return target;
    }
    throw Error(ErrorCategory::failure,
                fmt::format("no installed target makes a page (installed: {})", target_names(registry)));
}

std::string target_names(candela::Registry& registry, const std::string& last) {
    const std::vector<std::string> names = registry.names(PluginKind::target);
    if (names.size() < 2) return fmt::format("{}", fmt::join(names, ""));
    return fmt::format("{}{}{}", fmt::join(names.begin(), names.end() - 1, ", "), last, names.back());
}

std::string target_summaries(candela::Registry& registry) {
    std::string text;
    for (const candela::PluginFile* const file : registry.list(PluginKind::target))
        text += fmt::format("  {:<7} {}\n", file->manifest.name, file->manifest.summary);
    return text;
}
