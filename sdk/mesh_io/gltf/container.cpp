#include "mesh_io/gltf/container.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include "candela/target/base64.h"
#include "mesh_io/bad_file.h"

namespace mesh_io::gltf {

namespace {

constexpr std::string_view k_magic = "glTF";
constexpr std::uint32_t k_json = 0x4e4f534a;
constexpr std::uint32_t k_binary = 0x004e4942;

/// The chunks of a binary file. Some programs do not pad the JSON to a multiple of four bytes, or do not
/// count the padding.
class BinaryFile {
  public:
    BinaryFile(std::size_t size, const BytesAt& bytes_at) : size_(size), bytes_at_(bytes_at) {}

    Chunks chunks() {
        const std::uint32_t version = word(4);
        if (version != 2)
            throw BadFile(
                fmt::format("is binary glTF of version {}; Candela reads version 2. Convert it with: npx "
                            "gltf-pipeline -i OLD.glb -o NEW.glb",
                            version));
        const std::size_t length = word(8);
        if (length > size_)
            throw BadFile(fmt::format("is cut off: it should have {} bytes, but has {}", length, size_));
        size_ = length;
        constexpr std::size_t k_first = 12;
        if (word(k_first + 4) != k_json) throw BadFile("does not begin with a chunk of JSON");
        Chunks chunks{.json = chunk(k_first), .binary = {}};
        const std::size_t end = chunks.json.begin + chunks.json.size;
        for (const std::size_t at : {end, (end + 3) / 4 * 4}) {
            if (at + 8 > size_ || word(at + 4) != k_binary) continue;
            chunks.binary = chunk(at);
            chunks.has_binary = true;
            break;
        }
        return chunks;
    }

  private:
    std::uint32_t word(std::size_t at) const {
        if (at > size_ || size_ - at < 4) throw BadFile("ends within its chunks");
        const std::string_view bytes = bytes_at_(at, 4);
        std::uint32_t value = 0;
        for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[i]);
        return value;
    }
    Range chunk(std::size_t at) const {
        const std::size_t size = word(at);
        if (size > size_ - at - 8) throw BadFile("has a chunk that is longer than the file");
        return {.begin = at + 8, .size = size};
    }

    std::size_t size_;
    const BytesAt& bytes_at_;
};

}  // namespace

Chunks chunks_of(std::size_t size, const BytesAt& bytes_at) {
    if (bytes_at(0, std::min(size, k_magic.size())) == k_magic) return BinaryFile(size, bytes_at).chunks();
    return {.json = {.begin = 0, .size = size}, .binary = {}};
}

std::string decoded_percents(std::string_view uri) {
    std::string result;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const auto digit = [&](std::size_t at) {
            constexpr std::string_view k_digits = "0123456789abcdef";
            return at < uri.size() ? k_digits.find(static_cast<char>(uri[at] | 0x20))
                                   : std::string_view::npos;
        };
        if (uri[i] == '%' && digit(i + 1) < 16 && digit(i + 2) < 16) {
            result += static_cast<char>(digit(i + 1) * 16 + digit(i + 2));
            i += 2;
        } else {
            result += uri[i];
        }
    }
    return result;
}

std::optional<Array<char>> bytes_of_data_uri(std::string_view uri) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64")) return std::nullopt;
    try {
        const std::string bytes = candela::target::base64_decoded(uri.substr(comma + 1));
        return Array<char>(bytes.begin(), bytes.end());
    } catch (const std::invalid_argument&) {
        return std::nullopt;
    }
}

}  // namespace mesh_io::gltf
