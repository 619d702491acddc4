// A glTF document and its one buffer, as a GLB file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

#include "candela/math.h"

namespace candela::gltf_target {

using Json = nlohmann::ordered_json;

/// The extension for the mirrored share of a dielectric.
inline constexpr const char* k_specular = "KHR_materials_specular";

/// glTF 2.0, section 3.6: what a view of the buffer is for.
enum class ViewUse : int { image = 0, vertices = 34962, indices = 34963 };

class Document {
  public:
    /// Everything but `buffers`, `bufferViews` and `accessors`, which are added to by the functions below.
    Json root = Json::object();

    /// Appends to a list of the root, such as "nodes", and returns the index of the new element.
    std::size_t add(const char* list, Json element);
    /// Adds the extension to the list of those used.
    void use_extension(const char* name);

    /// Each returns the index of an accessor.
    std::size_t add_positions(ConstVec3Span positions, std::size_t count);  // with their bounds
    std::size_t add_vectors(ConstVec3Span vectors, std::size_t count);
    /// Unit vectors along `dpdu`, perpendicular to the normals; any, where it vanishes. With the side of the
    /// normals and tangents on which `dpdv` is.
    std::size_t add_tangents(ConstVec3Span dpdu, ConstVec3Span dpdv, ConstVec3Span normals,
                             std::size_t count);
    std::size_t add_texture_coordinates(ConstVec2Span coordinates, std::size_t count);  // v from the bottom
    std::size_t add_floats(std::span<const float> numbers, std::size_t per_element);
    std::size_t add_indices(std::span<const std::uint32_t> indices);

    /// Adds bytes and returns the index of their view.
    std::size_t add_bytes(std::string_view bytes, ViewUse use);

    /// The file. Invalid UTF-8 in names becomes replacement characters.
    std::string glb() const;

  private:
    std::string buffer_;
};

}  // namespace candela::gltf_target
