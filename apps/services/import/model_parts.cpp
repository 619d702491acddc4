#include "import/model_parts.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "import/gltf_container.h"

import candela.util;

namespace fs = std::filesystem;

namespace importing {

namespace {

constexpr std::size_t k_most_library_bytes = 64u << 20;
constexpr std::string_view k_blanks = " \t\r";

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool is_same_word(std::string_view a, std::string_view b) {
    return std::ranges::equal(a, b, {}, lower, lower);
}

/// Readers may ignore case when they look for a name, so names in another case count as the same file.
bool is_file(const fs::path& named, const fs::path& file) {
    std::error_code problem;
    if (fs::equivalent(named, file, problem)) return true;
    const fs::path target = candela::canonical_path(file);
    return is_same_word(named.filename().string(), target.filename().string()) &&
           fs::equivalent(named.parent_path() / ".", target.parent_path(), problem);
}

/// Whether `is_wanted` returns true for a line without its leading blanks.
template <class IsWanted>
bool any_line(std::string_view text, const IsWanted& is_wanted) {
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string_view line = text.substr(at, end - at);
        if (is_wanted(line.substr(std::min(line.find_first_not_of(k_blanks), line.size())))) return true;
        at = end + 1;
    }
    return false;
}

/// The possible names after a line's keyword: each word, or several with the blanks between them.
std::vector<std::string> possible_names(std::string_view line) {
    constexpr std::size_t k_most_words = 32;
    std::vector<std::pair<std::size_t, std::size_t>> words;
    for (std::size_t at = 0; at < line.size() && words.size() < k_most_words;) {
        const std::size_t end = std::min(line.find_first_of(k_blanks, at), line.size());
        words.emplace_back(at, end);
        at = std::min(line.find_first_not_of(k_blanks, end), line.size());
    }
    std::vector<std::string> names;
    for (std::size_t i = 1; i < words.size(); ++i) {
        for (std::size_t j = i; j < words.size(); ++j) {
            names.emplace_back(line.substr(words[i].first, words[j].second - words[i].first));
            std::ranges::replace(names.back(), '\\', '/');
        }
    }
    return names;
}

bool is_named(std::string_view line, const fs::path& folder, const fs::path& file) {
    return std::ranges::any_of(possible_names(line),
                               [&](const std::string& name) { return is_file(folder / name, file); });
}

bool is_part_of_library(const fs::path& library, const fs::path& file) {
    const auto text = candela::read_text_file(library, k_most_library_bytes);
    return text && any_line(*text, [&](std::string_view line) {
               return is_named(line, library.parent_path(), file);
           });
}

bool is_part_of_obj(const fs::path& model, const fs::path& file) {
    constexpr std::string_view k_keyword = "mtllib";
    const auto text = candela::read_text_file(model);
    return text && any_line(*text, [&](std::string_view line) {
               if (!is_same_word(line.substr(0, k_keyword.size()), k_keyword)) return false;
               return std::ranges::any_of(possible_names(line), [&](const std::string& name) {
                   const fs::path library = model.parent_path() / name;
                   return is_file(library, file) || is_part_of_library(library, file);
               });
           });
}

/// A texture named in a comment, as MeshLab writes it.
bool is_part_of_ply(const fs::path& model, const fs::path& file) {
    constexpr std::size_t k_longest_header = 1 << 16;
    const auto text = candela::read_text_file(model, k_longest_header);
    return text && any_line(*text, [&](std::string_view line) {
               return line.starts_with("comment") && is_named(line, model.parent_path(), file);
           });
}

bool is_named_in_gltf(const fs::path& model, const fs::path& file, bool with_pictures) {
    try {
        const gltf::Container container(Source{.file = model});
        return std::ranges::any_of(container.named_files(with_pictures),
                                   [&](const fs::path& named) { return is_file(named, file); });
    } catch (const candela::Error&) {
        return false;  // its reader will report the error
    }
}

bool is_gltf(const fs::path& model) {
    const std::string extension = candela::extension_of(model);
    return extension == "gltf" || extension == "glb";
}

}  // namespace

bool is_buffer_of(const fs::path& model, const fs::path& file) {
    // A GLB file contains its own buffer, and may be large.
    return candela::extension_of(model) == "gltf" && is_named_in_gltf(model, file, false);
}

bool is_part_of(const fs::path& model, const fs::path& file) {
    if (is_gltf(model)) return is_named_in_gltf(model, file, true);
    if (candela::extension_of(model) == "obj") return is_part_of_obj(model, file);
    return candela::extension_of(model) == "ply" && is_part_of_ply(model, file);
}

}  // namespace importing
