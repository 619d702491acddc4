#include "document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "candela/target/arrays.h"

namespace candela::gltf_target {

namespace {

constexpr int k_float = 5126;
constexpr int k_unsigned_int = 5125;
constexpr std::size_t k_alignment = 4;

template <class T>
std::string_view bytes_of(std::span<const T> numbers) {
    return {reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()};
}

void pad(std::string& bytes, char with) {
    bytes.append((k_alignment - bytes.size() % k_alignment) % k_alignment, with);
}

/// Four bytes, the least significant first.
void append(std::string& bytes, std::size_t number) {
    if (number > std::numeric_limits<std::uint32_t>::max())
        throw std::runtime_error("the scene exceeds the 4 GB limit of GLB files");
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(number >> shift & 255u);
}

void append_chunk(std::string& file, std::string_view type, const std::string& content) {
    append(file, content.size());
    file += type;
    file += content;
}

}  // namespace

std::size_t Document::add(const char* list, Json element) {
    Json& elements = root[list];
    elements.push_back(std::move(element));
    return elements.size() - 1;
}

void Document::use_extension(const char* name) {
    Json& used = root["extensionsUsed"];
    if (std::ranges::find(used, Json(name)) == used.end()) used.push_back(name);
}

std::size_t Document::add_bytes(std::string_view bytes, ViewUse use) {
    pad(buffer_, '\0');
    Json view = {{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", bytes.size()}};
    if (use != ViewUse::image) view["target"] = static_cast<int>(use);
    buffer_ += bytes;
    return add("bufferViews", std::move(view));
}

std::size_t Document::add_floats(std::span<const float> numbers, std::size_t per_element) {
    const std::size_t view = add_bytes(bytes_of(numbers), ViewUse::vertices);
    return add("accessors", {{"bufferView", view},
                             {"componentType", k_float},
                             {"count", numbers.size() / per_element},
                             {"type", per_element == 1 ? "SCALAR" : fmt::format("VEC{}", per_element)}});
}

std::size_t Document::add_positions(ConstVec3Span positions, std::size_t count) {
    const std::size_t accessor = add_vectors(positions, count);
    Json& json = root["accessors"][accessor];
    for (const float* const axis : {positions.x, positions.y, positions.z}) {
        const auto [low, high] = std::ranges::minmax(std::span(axis, count));
        json["min"].push_back(low);
        json["max"].push_back(high);
    }
    return accessor;
}

std::size_t Document::add_vectors(ConstVec3Span vectors, std::size_t count) {
    return add_floats(target::interleaved(vectors, count), 3);
}

std::size_t Document::add_tangents(ConstVec3Span dpdu, ConstVec3Span dpdv, ConstVec3Span normals,
                                   std::size_t count) {
    std::vector<float> numbers;
    numbers.reserve(4 * count);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 n = normals[i], aside = std::abs(n.x) < 0.7f ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        constexpr float k_least = 1e-6f;
        Vec3 t = dpdu[i] - dot(dpdu[i], n) * n;
        if (!(length(t) > k_least * length(dpdu[i]))) t = aside - dot(aside, n) * n;
        t = (1 / length(t)) * t;
        const float side = dot(cross(n, t), dpdv[i]) < 0 ? -1.0f : 1.0f;
        numbers.insert(numbers.end(), {t.x, t.y, t.z, side});
    }
    return add_floats(numbers, 4);
}

std::size_t Document::add_texture_coordinates(ConstVec2Span coordinates, std::size_t count) {
    std::vector<float> numbers = target::interleaved(coordinates, count);
    for (std::size_t i = 1; i < numbers.size(); i += 2)
        numbers[i] = 1 - numbers[i];  // glTF's v is from the top
    return add_floats(numbers, 2);
}

std::size_t Document::add_indices(std::span<const std::uint32_t> indices) {
    const std::size_t view = add_bytes(bytes_of(indices), ViewUse::indices);
    return add("accessors", {{"bufferView", view},
                             {"componentType", k_unsigned_int},
                             {"count", indices.size()},
                             {"type", "SCALAR"}});
}

std::string Document::glb() const {
    std::string buffer = buffer_;
    pad(buffer, '\0');
    Json whole = root;
    if (!buffer.empty()) whole["buffers"] = Json::array({{{"byteLength", buffer_.size()}}});
    std::string json = whole.dump(-1, ' ', false, Json::error_handler_t::replace);
    pad(json, ' ');
    constexpr std::size_t k_head = 12, k_chunk_head = 8;
    std::string file = "glTF";
    append(file, 2);
    append(file, k_head + k_chunk_head + json.size() + (buffer.empty() ? 0 : k_chunk_head + buffer.size()));
    append_chunk(file, "JSON", json);
    if (!buffer.empty()) append_chunk(file, std::string_view("BIN\0", 4), buffer);
    return file;
}

}  // namespace candela::gltf_target
