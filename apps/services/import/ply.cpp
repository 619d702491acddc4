// Textures of PLY files by MeshLab; the format has no materials.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "import/named_file.h"
#include "import/readers.h"
#include "mesh_io/bad_file.h"
#include "mesh_io/file_bytes.h"
#include "mesh_io/ply_header.h"

import candela.plugins;
import candela.util;

namespace fs = std::filesystem;

namespace importing {

std::vector<std::string> textures_of_ply(const fs::path& file) {
    try {
        mesh_io::Pieces pieces(file);
        constexpr std::size_t k_longest_header = 1 << 20;
        const std::string_view bytes = pieces.at(0, std::min(pieces.size(), k_longest_header));
        return mesh_io::ply::texture_files(
            mesh_io::ply::read_header(mesh_io::without_mark(bytes), pieces.size()));
    } catch (const mesh_io::BadFile&) {
        return {};  // the shape `mesh` reports the error
    }
}

Model read_ply(const Source& source, candela::Registry& registry) {
    Model model;
    Part& part = model.parts.emplace_back();
    const std::vector<std::string> names = textures_of_ply(source.file);
    if (names.empty()) return model;
    const std::string& name = names.front();
    if (names.size() > 1) model.note(fmt::format("only the first of its {} textures is shown", names.size()));
    const auto found = find_named(source.file.parent_path(), name);
    if (!found) {
        model.note(fmt::format("its texture '{}' does not exist", name));
        return model;
    }
    const fs::path& image = found->path;
    if (!source.may_read(image)) {
        model.note(fmt::format("the texture '{}' is outside the model's folder{}", name, k_outside_remedy));
    } else if (!is_readable_image(image, registry)) {
        model.note(fmt::format("no image plugin reads the format of the texture '{}'{}", name,
                               candela::possible_formats(registry, candela::FormatUse::read)));
    } else {
        part.material = 0;
        model.materials.push_back(
            {.name = "",
             .values = {{"ka", {0.3}}, {"kd", {0.75}}, {"ks", {0.2}}, {"shininess", {40}}},
             .color_map = ParameterMap{.parameter = "color"}});
        model.images.push_back({candela::canonical_path(image)});
    }
    return model;
}

}  // namespace importing
