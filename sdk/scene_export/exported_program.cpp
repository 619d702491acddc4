#include "scene_export/exported_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

import candela.api;
import candela.plugins;

namespace candela {

namespace {

bool stays_in_its_folder(const std::filesystem::path& name) {
    return !name.empty() && name.is_relative() && name.has_filename() && name.filename() != "." &&
           std::ranges::find(name, "..") == name.end();
}

/// Keeps files until all are complete.
class Collected final : public FileSink {
  public:
    void write(const char* name, std::span<const std::byte> content) override {
        if (!stays_in_its_folder(name))
            throw std::invalid_argument(
                fmt::format("'{}' is not a valid name for a file in the program's folder", name));
        std::vector<ExportedFile>& files = program_.files;
        if (std::ranges::find(files, name, &ExportedFile::name) != files.end())
            throw std::invalid_argument(fmt::format("the file '{}' is written twice", name));
        files.push_back({name, {reinterpret_cast<const char*>(content.data()), content.size()}});
    }
    void approximate(const char* sentence) override {
        std::vector<std::string>& said = program_.approximations;
        if (std::ranges::find(said, sentence) == said.end()) said.emplace_back(sentence);
    }
    ExportedProgram taken() { return std::move(program_); }

  private:
    ExportedProgram program_;
};

}  // namespace

ExportedProgram program_of(const Target& target, const std::string& name, const ExportedScene& scene) {
    Collected files;
    try {
        target.write(scene, files);
    } catch (...) {
        rethrow_as_plugin_error(PluginKind::target, name);
    }
    return files.taken();
}

}  // namespace candela
