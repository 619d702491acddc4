#include "support/gltf_square.h"

#include <cstddef>

namespace {

std::string big_endian(std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255);
    return bytes;
}

std::string chunk(const std::string& type_and_data) {
    std::uint32_t crc = 0xffff'ffffu;
    for (const char c : type_and_data) {
        crc ^= static_cast<unsigned char>(c);
        for (int k = 0; k < 8; ++k) crc = crc >> 1 ^ (0xedb8'8320u & (0u - (crc & 1)));
    }
    return big_endian(static_cast<std::uint32_t>(type_and_data.size() - 4)) + type_and_data +
           big_endian(~crc);
}

}  // namespace

std::string png(int width, int height, const std::vector<RgbaPixel>& pixels) {
    std::string raw;
    for (int y = 0; y < height; ++y) {
        raw += '\0';
        for (int x = 0; x < width; ++x)
            for (const std::uint8_t v : pixels[static_cast<std::size_t>(y * width + x)])
                raw += static_cast<char>(v);
    }
    std::uint32_t a = 1, b = 0;
    for (const char c : raw) {
        a = (a + static_cast<unsigned char>(c)) % 65521;
        b = (b + a) % 65521;
    }
    const auto size = static_cast<std::uint16_t>(raw.size());
    const std::string stored = {'\x78',
                                '\x01',
                                '\x01',
                                static_cast<char>(size & 255),
                                static_cast<char>(size >> 8),
                                static_cast<char>(~size & 255),
                                static_cast<char>(~size >> 8 & 255)};
    return "\x89PNG\r\n\x1a\n" +
           chunk("IHDR" + big_endian(static_cast<std::uint32_t>(width)) +
                 big_endian(static_cast<std::uint32_t>(height)) + std::string("\x08\x06\0\0\0", 5)) +
           chunk("IDAT" + stored + raw + big_endian(b << 16 | a)) + chunk("IEND");
}

GltfSquare::GltfSquare(bool has_normals)
    : GltfFile(Json::parse(R"({"scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {}, "material": 0}]}], "materials": [{"doubleSided": true}]})")) {
    primitive()["attributes"]["POSITION"] = floats("VEC3", {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0});
    primitive()["attributes"]["TEXCOORD_0"] = floats("VEC2", {0, 1, 1, 1, 1, 0, 0, 0});
    if (has_normals)
        primitive()["attributes"]["NORMAL"] = floats("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    primitive()["indices"] = integers({0, 1, 2, 0, 2, 3});
}

GltfFile::Json GltfSquare::texture(const std::string& image) {
    const std::size_t at = view(image.data(), image.size());
    json["images"].push_back({{"bufferView", at}, {"mimeType", "image/png"}});
    json["textures"].push_back({{"source", json["images"].size() - 1}});
    return {{"index", json["textures"].size() - 1}};
}
