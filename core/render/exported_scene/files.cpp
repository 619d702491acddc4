module;

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

module candela.exported_scene;

import candela.library;

namespace candela {

namespace {

bool stays_in_its_folder(const std::filesystem::path& name) {
    return !name.empty() && name.is_relative() && name.has_filename() && name.filename() != "." &&
           std::ranges::find(name, "..") == name.end();
}

/// Files are kept until all are there.
class Collected final : public FileSink {
  public:
    void write(const char* name, std::span<const std::byte> content) override {
        if (!stays_in_its_folder(name))
            throw std::invalid_argument(
                fmt::format("'{}' is no name of a file in the program's folder", name));
        if (std::ranges::find(files_, name, &ExportedFile::name) != files_.end())
            throw std::invalid_argument(fmt::format("the file '{}' is written twice", name));
        files_.push_back({name, {reinterpret_cast<const char*>(content.data()), content.size()}});
    }
    std::vector<ExportedFile> taken() { return std::move(files_); }

  private:
    std::vector<ExportedFile> files_;
};

}  // namespace

std::vector<ExportedFile> files_of(const Target& target, const std::string& name,
                                   const ExportedScene& scene) {
    Collected files;
    try {
        target.write(scene, files);
    } catch (...) {
        rethrow_as_plugin_error(PluginKind::target, name);
    }
    return files.taken();
}

}  // namespace candela
