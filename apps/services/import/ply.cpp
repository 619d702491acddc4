// Textures of PLY files by MeshLab; the format has no materials.
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "import/named_file.h"
#include "import/readers.h"

import candela.plugins;
import candela.util;

namespace fs = std::filesystem;

namespace importing {

namespace {

/// The names after "comment TextureFile" in a PLY file's header.
std::vector<std::string> texture_names(const fs::path& file) {
    std::vector<std::string> names;
    std::ifstream in(file, std::ios::binary);
    constexpr std::string_view k_key = "comment TextureFile ";
    constexpr int k_most_lines = 1000;
    std::string line;
    for (int i = 0; i < k_most_lines && std::getline(in, line) && !line.starts_with("end_header"); ++i) {
        while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
        if (line.starts_with(k_key)) names.push_back(line.substr(k_key.size()));
    }
    return names;
}

}  // namespace

Model read_ply(const Source& source, candela::Registry& registry) {
    Model model;
    Part& part = model.parts.emplace_back();
    const std::vector<std::string> names = texture_names(source.file);
    if (names.empty()) return model;
    const std::string& name = names.front();
    if (names.size() > 1) model.note(fmt::format("only the first of its {} textures is shown", names.size()));
    const auto found = find_named(source.file.parent_path(), name);
    if (!found) {
        model.note(fmt::format("its texture '{}' does not exist", name));
        return model;
    }
    const fs::path& picture = found->path;
    if (!source.may_read(picture)) {
        model.note(fmt::format("the texture '{}' is outside the model's folder{}", name, k_outside_remedy));
    } else if (!is_readable_picture(picture, registry)) {
        model.note(fmt::format("no image plugin reads the format of the texture '{}'{}", name,
                               candela::possible_formats(registry, candela::FormatUse::read)));
    } else {
        part.material = 0;
        model.materials.push_back(
            {.name = "",
             .values = {{"ka", {0.3}}, {"kd", {0.75}}, {"ks", {0.2}}, {"shininess", {40}}},
             .picture = 0});
        model.pictures.push_back({candela::canonical_path(picture)});
    }
    return model;
}

}  // namespace importing
