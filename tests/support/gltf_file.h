// Writes glTF files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// A glTF file with one buffer. Tests set members of its JSON, and add the numbers that these refer to.
class GltfFile {
  public:
    using Json = nlohmann::json;

    static constexpr int k_ubyte = 5121, k_uint = 5125, k_float = 5126;

    /// The version is added.
    explicit GltfFile(Json members) : json(std::move(members)) { json["asset"] = {{"version", "2.0"}}; }

    /// Each returns the index of what it adds.
    std::size_t view(const void* bytes, std::size_t size);
    template <class T>
    std::size_t view(const std::vector<T>& values) {
        return view(values.data(), values.size() * sizeof(T));
    }
    /// With any members besides its type, such as its view.
    std::size_t accessor(int component_type, const char* type, std::size_t count, Json more);
    template <class T>
    std::size_t accessor(int component_type, const char* type, std::size_t count,
                         const std::vector<T>& values) {
        const std::size_t of = view(values);
        return accessor(component_type, type, count, Json{{"bufferView", of}});
    }
    /// `type` is SCALAR or VEC2 to VEC4.
    std::size_t floats(const char* type, const std::vector<float>& values);
    std::size_t integers(const std::vector<std::uint32_t>& values);

    /// The file's bytes as GLB.
    std::string glb();
    /// Writes NAME.gltf and NAME.bin.
    void write(const std::filesystem::path& folder, const std::string& name);

    Json json;

  private:
    std::string bytes_;
};
