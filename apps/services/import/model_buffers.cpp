#include "import/model_buffers.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <system_error>

#include "mesh_io/bad_file.h"

import candela.util;

namespace fs = std::filesystem;

namespace importing {

namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

bool is_same_word(std::string_view a, std::string_view b) {
    return std::ranges::equal(a, b, {}, lower, lower);
}

bool is_file(const fs::path& named, const fs::path& file) {
    std::error_code problem;
    if (fs::equivalent(named, file, problem)) return true;
    const fs::path target = candela::canonical_path(file);
    return is_same_word(named.filename().string(), target.filename().string()) &&
           fs::equivalent(named.parent_path() / ".", target.parent_path(), problem);
}

namespace gltf {

Head head_of(mesh_io::Pieces& file) {
    const auto bytes_at = [&](std::size_t begin, std::size_t count) { return file.at(begin, count); };
    const mesh_io::gltf::Chunks chunks = mesh_io::gltf::chunks_of(file.size(), bytes_at);
    const std::string_view json = file.at(chunks.json.begin, chunks.json.size);
    return {chunks, mesh_io::gltf::parsed(mesh_io::without_mark(json))};
}

bool is_named(const fs::path& model, const fs::path& file, Named parts) {
    const auto is_named_in = [&](const mesh_io::gltf::Json& json, const char* kind) {
        return std::ranges::any_of(mesh_io::gltf::array_of(json, kind), [&](const auto& entry) {
            const std::string uri = mesh_io::gltf::text_of(entry, "uri");
            return !uri.empty() && !uri.starts_with("data:") &&
                   is_file(fs::absolute(model).parent_path() / mesh_io::gltf::decoded_percents(uri), file);
        });
    };
    try {
        mesh_io::Pieces pieces(model);
        const Head head = head_of(pieces);
        return is_named_in(head.json, "buffers") ||
               (parts == Named::buffers_and_images && is_named_in(head.json, "images"));
    } catch (const mesh_io::BadFile&) {
        return false;
    }
}

}  // namespace gltf

bool is_buffer_of(const fs::path& model, const fs::path& file) {
    // A GLB file contains its own buffer, and may be large.
    return candela::extension_of(model) == "gltf" && gltf::is_named(model, file, gltf::Named::buffers);
}

}  // namespace importing
