#include "import/gltf_container.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "import/model_buffers.h"
#include "mesh_io/bad_file.h"
#include "mesh_io/gltf/elements.h"

import candela.util;

namespace fs = std::filesystem;

namespace importing::gltf {

namespace {

[[noreturn]] void fail(const std::string& what) {
    throw candela::Error(candela::ErrorCategory::failure, what);
}

/// The content of a data: URI.
mesh_io::Array<char> data_of(std::string_view uri) {
    auto bytes = mesh_io::gltf::bytes_of_data_uri(uri);
    if (!bytes) fail("its data: URI is not valid base64");
    return *std::move(bytes);
}

/// The extension of a picture's format, from its first bytes.
const char* extension_of(std::string_view content) {
    if (content.starts_with("\x89PNG")) return "png";
    if (content.starts_with("\xff\xd8\xff")) return "jpg";
    if (content.starts_with("RIFF") && content.substr(8).starts_with("WEBP")) return "webp";
    if (content.starts_with("\xabKTX")) return "ktx2";
    if (content.starts_with("DDS ")) return "dds";
    fail("it is not a picture");
}

/// A file name made from the image's own name.
std::string stem_of(const std::string& name, std::size_t number) {
    std::string stem;
    for (const char c : name) {
        const bool is_plain =
            (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
        stem += is_plain ? c : '_';
    }
    constexpr std::size_t k_longest = 60;
    return fmt::format("{}{}{}", stem.substr(0, k_longest), stem.empty() ? "texture" : "_", number);
}

}  // namespace

Container::Container(const Source& source) try : source_(source), file_(source.file) {
    Head head = head_of(file_);
    chunks_ = head.chunks;
    json_ = std::move(head.json);
} catch (const mesh_io::BadFile& problem) {
    fail(fmt::format("'{}' {}", source.file.string(), problem.what()));
}

fs::path Container::part_named(const std::string& uri) const {
    const fs::path path = candela::canonical_path(fs::absolute(source_.file).parent_path() /
                                                  mesh_io::gltf::decoded_percents(uri));
    if (!source_.may_read(path))
        fail(fmt::format("'{}' is outside the model's folder{}", candela::shortened(uri), k_outside_remedy));
    std::error_code problem;
    if (!fs::is_regular_file(path, problem))
        fail(fmt::format("'{}' does not exist", candela::shortened(uri)));
    return path;
}

std::string_view Container::buffer(std::size_t index) {
    const auto known = buffers_.find(index);
    if (known != buffers_.end()) return mesh_io::text_of(known->second);
    return mesh_io::text_of(buffers_[index] = read_buffer(index));
}

mesh_io::Array<char> Container::read_buffer(std::size_t index) {
    const Json* const buffer = element(array_of(json_, "buffers"), index);
    if (buffer == nullptr) fail(fmt::format("buffer {} does not exist", index));
    const std::string uri = text_of(*buffer, "uri");
    if (uri.starts_with("data:")) return data_of(uri);
    try {
        if (!uri.empty()) return mesh_io::read_file(part_named(uri));
        if (index > 0) return {};
        const std::string_view bytes = file_.at(chunks_.binary.begin, chunks_.binary.size);
        return {bytes.begin(), bytes.end()};
    } catch (const mesh_io::BadFile& problem) {
        fail(fmt::format("'{}' {}", candela::shortened(uri.empty() ? source_.file.string() : uri),
                         problem.what()));
    }
}

std::string_view Container::view(std::size_t index) {
    const Json* const view = element(array_of(json_, "bufferViews"), index);
    if (view == nullptr) fail(fmt::format("buffer view {} does not exist", index));
    const std::string_view bytes = buffer(index_of(*view, "buffer").value_or(0));
    const std::size_t first = index_of(*view, "byteOffset").value_or(0),
                      size = index_of(*view, "byteLength").value_or(0);
    if (first > bytes.size() || size > bytes.size() - first) fail("its bytes are not in the file");
    return bytes.substr(first, size);
}

std::vector<double> Container::values(std::size_t accessor, std::size_t components) {
    const Json* const from = element(array_of(json_, "accessors"), accessor);
    const auto index = from != nullptr ? index_of(*from, "bufferView") : std::nullopt;
    if (!index || from->contains("sparse")) fail(fmt::format("accessor {} has no buffer view", accessor));
    if (text_of(*from, "type") != (components == 1 ? "SCALAR" : fmt::format("VEC{}", components)))
        fail(fmt::format("accessor {} is of another type", accessor));
    const std::size_t kind = index_of(*from, "componentType").value_or(0);
    const int type = kind <= mesh_io::gltf::k_float ? static_cast<int>(kind) : 0;
    if (mesh_io::gltf::size_of(type) == 0 || type == mesh_io::gltf::k_unsigned_int)
        fail(fmt::format("accessor {} has an unknown component type, {}", accessor, kind));
    const std::string_view bytes = view(*index);
    const auto stride = index_of(array_of(json_, "bufferViews")[*index], "byteStride");
    const std::size_t count = index_of(*from, "count").value_or(0);
    const auto elements = mesh_io::gltf::elements_in(bytes, index_of(*from, "byteOffset").value_or(0), stride,
                                                     type, components, count);
    if (!elements || count == 0) fail(fmt::format("the bytes of accessor {} are not in the file", accessor));
    std::vector<double> result;
    result.reserve(count * components);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t c = 0; c < components; ++c) {
            // glTF 2.0, 3.11: integers are fractions of 1.
            const double value = elements->number(i, c, true);
            if (!std::isfinite(value)) fail(fmt::format("accessor {} contains a non-finite value", accessor));
            result.push_back(value);
        }
    }
    return result;
}

Image Container::image(std::size_t index) {
    const Json& from = array_of(json_, "images").at(index);
    const std::string uri = text_of(from, "uri");
    if (!uri.empty() && !uri.starts_with("data:")) return {part_named(uri)};
    const auto embedded = index_of(from, "bufferView");
    if (uri.empty() && !embedded) fail("it has neither a name nor bytes");
    const mesh_io::Array<char> own = uri.empty() ? mesh_io::Array<char>() : data_of(uri);
    const std::string_view bytes = uri.empty() ? view(*embedded) : mesh_io::text_of(own);
    std::string content(bytes);
    const char* const extension = extension_of(content);
    return {fmt::format("{}.{}", stem_of(text_of(from, "name"), index), extension), std::move(content)};
}

}  // namespace importing::gltf
