#include "import/model_parts.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "import/model_buffers.h"
#include "import/readers.h"
#include "mesh_io/bad_file.h"
#include "mesh_io/obj_statements.h"

import candela.util;

namespace fs = std::filesystem;

namespace importing {

namespace {

constexpr std::size_t k_most_library_bytes = 64u << 20;
constexpr std::string_view k_blanks = " \t";

/// The names that the rest of a statement may contain: each word, or several with the blanks between them.
std::vector<std::string> possible_names(std::string_view rest) {
    constexpr std::size_t k_most_words = 32;
    std::vector<std::pair<std::size_t, std::size_t>> words;
    for (std::size_t at = 0; at < rest.size() && words.size() < k_most_words;) {
        const std::size_t end = std::min(rest.find_first_of(k_blanks, at), rest.size());
        words.emplace_back(at, end);
        at = std::min(rest.find_first_not_of(k_blanks, end), rest.size());
    }
    std::vector<std::string> names;
    for (std::size_t i = 0; i < words.size(); ++i) {
        for (std::size_t j = i; j < words.size(); ++j) {
            names.emplace_back(rest.substr(words[i].first, words[j].second - words[i].first));
            std::ranges::replace(names.back(), '\\', '/');
        }
    }
    return names;
}

/// Whether `is_wanted` returns true for a statement of a text, with the names that it may contain.
template <class IsWanted>
bool any_statement(const std::optional<std::string>& text, const IsWanted& is_wanted) {
    bool is_found = false;
    try {
        mesh_io::each_statement(text ? *text : std::string_view(),
                                [&](const mesh_io::Statement& s) { is_found = is_found || is_wanted(s); });
    } catch (const mesh_io::BadFile&) {
        return false;  // its reader will report the error
    }
    return is_found;
}

bool is_named(std::string_view rest, const fs::path& folder, const fs::path& file) {
    return std::ranges::any_of(possible_names(rest),
                               [&](const std::string& name) { return is_file(folder / name, file); });
}

bool is_part_of_library(const fs::path& library, const fs::path& file) {
    return any_statement(
        candela::read_text_file(library, k_most_library_bytes),
        [&](const mesh_io::Statement& s) { return is_named(s.rest, library.parent_path(), file); });
}

bool is_part_of_obj(const fs::path& model, const fs::path& file) {
    return any_statement(candela::read_text_file(model), [&](const mesh_io::Statement& s) {
        return is_same_word(s.keyword, "mtllib") &&
               std::ranges::any_of(possible_names(s.rest), [&](const std::string& name) {
                   const fs::path library = model.parent_path() / name;
                   return is_file(library, file) || is_part_of_library(library, file);
               });
    });
}

bool is_part_of_ply(const fs::path& model, const fs::path& file) {
    return std::ranges::any_of(textures_of_ply(model), [&](std::string name) {
        std::ranges::replace(name, '\\', '/');
        return is_file(model.parent_path() / name, file);
    });
}

bool is_gltf(const fs::path& model) {
    const std::string extension = candela::extension_of(model);
    return extension == "gltf" || extension == "glb";
}

}  // namespace

bool is_part_of(const fs::path& model, const fs::path& file) {
    if (is_gltf(model)) return gltf::is_named(model, file, gltf::Named::buffers_and_images);
    if (candela::extension_of(model) == "obj") return is_part_of_obj(model, file);
    return candela::extension_of(model) == "ply" && is_part_of_ply(model, file);
}

}  // namespace importing
