#include "import/gltf_container.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <utility>

#include "candela/target/literals.h"
#include "import/readers.h"

import candela.util;

namespace fs = std::filesystem;

namespace importing::gltf {

namespace {

[[noreturn]] void fail(const std::string& what) {
    throw candela::Error(candela::ErrorCategory::failure, what);
}

/// Returns fewer bytes than requested at the end of the file.
std::string bytes_at(candela::RegularFile& file, std::uint64_t begin, std::size_t size) {
    std::string bytes(begin < file.size() ? std::min<std::uint64_t>(size, file.size() - begin) : 0, '\0');
    const auto count = file.seek(begin) ? file.read(bytes) : std::nullopt;
    bytes.resize(count.value_or(0));
    return bytes;
}

/// A little-endian number of four bytes; zero beyond the end.
std::size_t word_at(std::string_view bytes, std::size_t at) {
    if (at > bytes.size() || bytes.size() - at < 4) return 0;
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

constexpr std::uint32_t k_json_chunk = 0x4e4f534a, k_binary_chunk = 0x004e4942;

/// The chunk of that type, among the first few: files have two. Some programs do not count the padding before
/// a chunk.
Chunk chunk_of(candela::RegularFile& file, std::uint32_t type) {
    constexpr std::size_t k_header = 8;
    std::uint64_t at = 12;
    for (int chunks = 0; chunks < 16 && at + k_header <= file.size(); ++chunks) {
        const std::string header = bytes_at(file, at, k_header);
        const std::size_t size = word_at(header, 0);
        if (size > file.size() - at - k_header) break;
        if (word_at(header, 4) == type) return {.begin = at + k_header, .size = size};
        const std::uint64_t end = at + k_header + size;
        const std::uint64_t padded = (end + 3) / 4 * 4;
        at = word_at(bytes_at(file, end, k_header), 4) == type ? end : padded;
    }
    return {};
}

std::string decoded_percents(std::string_view uri) {
    std::string result;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const auto digit = [&](std::size_t at) {
            return at < uri.size()
                       ? std::string_view("0123456789abcdef").find(static_cast<char>(uri[at] | 0x20))
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

/// The content of a data: URI.
std::string data_of(std::string_view uri) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64"))
        fail("its data: URI is not valid base64");
    try {
        return candela::target::base64_decoded(uri.substr(comma + 1));
    } catch (const std::invalid_argument&) {
        fail("its data: URI is not valid base64");
    }
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

Container::Container(Source source) : source_(std::move(source)), file_(source_.file) {
    constexpr std::string_view k_magic = "glTF";
    std::string json;
    if (file_.is_open() && bytes_at(file_, 0, k_magic.size()) == k_magic) {
        binary_ = chunk_of(file_, k_binary_chunk);
        const Chunk chunk = chunk_of(file_, k_json_chunk);
        json = bytes_at(file_, chunk.begin, chunk.size);
        while (json.ends_with('\0')) json.pop_back();
    } else {
        auto text = candela::read_text_file(source_.file);
        if (!text) fail(fmt::format("'{}' cannot be read", source_.file.string()));
        json = std::move(*text);
    }
    json_ = Json::parse(json, nullptr, false);
    if (!json_.is_object())
        fail(fmt::format("'{}' is not a glTF file: it has no JSON object", source_.file.string()));
}

fs::path Container::part_named(const std::string& uri) const {
    const fs::path path =
        candela::canonical_path(fs::absolute(source_.file).parent_path() / decoded_percents(uri));
    if (!source_.may_read(path))
        fail(fmt::format("'{}' is outside the model's folder{}", candela::shortened(uri), k_outside_remedy));
    std::error_code problem;
    if (!fs::is_regular_file(path, problem))
        fail(fmt::format("'{}' does not exist", candela::shortened(uri)));
    return path;
}

std::string_view Container::buffer(std::size_t index) {
    const auto known = buffers_.find(index);
    if (known != buffers_.end()) return known->second;
    const Json* const buffer = element(array_of(json_, "buffers"), index);
    if (buffer == nullptr) fail(fmt::format("buffer {} does not exist", index));
    const std::string uri = text(*buffer, "uri");
    if (uri.empty() && index > 0) return {};
    std::string& content = buffers_[index];
    if (uri.empty()) return content = bytes_at(file_, binary_.begin, binary_.size);
    if (uri.starts_with("data:")) return content = data_of(uri);
    auto read = candela::read_text_file(part_named(uri));
    if (!read) fail(fmt::format("'{}' cannot be read", candela::shortened(uri)));
    return content = std::move(*read);
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
    if (text(*from, "type") != (components == 1 ? "SCALAR" : fmt::format("VEC{}", components)))
        fail(fmt::format("accessor {} is of another type", accessor));
    const std::size_t kind = index_of(*from, "componentType").value_or(0);
    constexpr std::size_t k_byte = 5120, k_unsigned_byte = 5121, k_short = 5122, k_unsigned_short = 5123,
                          k_float = 5126;
    const std::size_t size = kind == k_float                               ? 4
                             : kind == k_short || kind == k_unsigned_short ? 2
                             : kind == k_byte || kind == k_unsigned_byte   ? 1
                                                                           : 0;
    if (size == 0) fail(fmt::format("accessor {} has an unknown component type, {}", accessor, kind));
    const std::string_view bytes = view(*index);
    const std::size_t stride =
        index_of(array_of(json_, "bufferViews")[*index], "byteStride").value_or(components * size);
    const std::size_t first = index_of(*from, "byteOffset").value_or(0),
                      count = index_of(*from, "count").value_or(0), each = components * size;
    if (stride < each || first > bytes.size() || count == 0 || bytes.size() - first < each ||
        (bytes.size() - first - each) / stride < count - 1)
        fail(fmt::format("the bytes of accessor {} are not in the file", accessor));
    std::vector<double> result;
    result.reserve(count * components);
    for (std::size_t i = 0; i < count * components; ++i) {
        const std::size_t at = first + i / components * stride + i % components * size;
        std::uint32_t word = 0;
        for (std::size_t k = size; k-- > 0;) word = word << 8 | static_cast<unsigned char>(bytes[at + k]);
        // glTF 2.0, 3.11: integers are fractions of 1.
        const double value = kind == k_float            ? std::bit_cast<float>(word)
                             : kind == k_unsigned_short ? word / 65535.0
                             : kind == k_unsigned_byte  ? word / 255.0
                             : kind == k_short ? std::max(static_cast<std::int16_t>(word) / 32767.0, -1.0)
                                               : std::max(static_cast<std::int8_t>(word) / 127.0, -1.0);
        if (!std::isfinite(value)) fail(fmt::format("accessor {} contains a non-finite value", accessor));
        result.push_back(value);
    }
    return result;
}

std::vector<fs::path> Container::named_files(bool with_images) const {
    std::vector<fs::path> files;
    for (const char* const kind : {"buffers", "images"}) {
        if (kind == std::string_view("images") && !with_images) break;
        for (const Json& entry : array_of(json_, kind)) {
            const std::string uri = text(entry, "uri");
            if (!uri.empty() && !uri.starts_with("data:"))
                files.push_back(fs::absolute(source_.file).parent_path() / decoded_percents(uri));
        }
    }
    return files;
}

Picture Container::picture(std::size_t image) {
    const Json& from = array_of(json_, "images").at(image);
    const std::string uri = text(from, "uri");
    if (!uri.empty() && !uri.starts_with("data:")) return {part_named(uri)};
    const auto index = index_of(from, "bufferView");
    if (uri.empty() && !index) fail("it has neither a name nor bytes");
    std::string content = uri.empty() ? std::string(view(*index)) : data_of(uri);
    const char* const extension = extension_of(content);
    return {fmt::format("{}.{}", stem_of(text(from, "name"), image), extension), std::move(content)};
}

}  // namespace importing::gltf
