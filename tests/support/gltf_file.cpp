#include "support/gltf_file.h"

#include <cstring>
#include <utility>

#include "support/command.h"

std::size_t GltfFile::view(const void* bytes, std::size_t size) {
    const std::size_t at = (bytes_.size() + 3) / 4 * 4;
    bytes_.resize(at + size);
    if (size > 0) std::memcpy(bytes_.data() + at, bytes, size);
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", at}, {"byteLength", size}});
    return json["bufferViews"].size() - 1;
}

std::size_t GltfFile::accessor(int component_type, const char* type, std::size_t count, Json more) {
    more.update({{"componentType", component_type}, {"type", type}, {"count", count}});
    json["accessors"].push_back(std::move(more));
    return json["accessors"].size() - 1;
}

std::size_t GltfFile::floats(const char* type, const std::vector<float>& values) {
    const std::size_t each = *type == 'V' ? static_cast<std::size_t>(type[3] - '0') : 1;
    return accessor(k_float, type, values.size() / each, values);
}

std::size_t GltfFile::integers(const std::vector<std::uint32_t>& values) {
    return accessor(k_uint, "SCALAR", values.size(), values);
}

std::string GltfFile::glb() {
    json["buffers"] = {{{"byteLength", bytes_.size()}}};
    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string data = bytes_;
    data.resize((data.size() + 3) / 4 * 4);
    std::string result = "glTF";
    const auto word = [&](std::size_t value) {
        for (int shift = 0; shift < 32; shift += 8) result += static_cast<char>(value >> shift & 255);
    };
    for (const std::size_t value : {std::size_t{2}, 12 + 8 + text.size() + 8 + data.size(), text.size()})
        word(value);
    result += "JSON" + text;
    word(data.size());
    return result + std::string("BIN\0", 4) + data;
}

void GltfFile::write(const std::filesystem::path& folder, const std::string& name) {
    json["buffers"] = {{{"byteLength", bytes_.size()}, {"uri", name + ".bin"}}};
    write_file(folder / (name + ".bin"), bytes_);
    write_file(folder / (name + ".gltf"), json.dump());
}
