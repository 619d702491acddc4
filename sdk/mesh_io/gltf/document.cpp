// tinygltf is compiled here and nowhere else: with exceptions, and without images.
#define TINYGLTF_IMPLEMENTATION
#include "mesh_io/gltf/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "candela/target/literals.h"
#include "mesh_io/file_bytes.h"
#include "mesh_io/gltf/draco.h"
#include "mesh_io/gltf/json.h"
#include "mesh_io/gltf/meshopt.h"
#include "mesh_io/surface.h"
#include "mesh_io/text_scanner.h"

namespace mesh_io::gltf {

namespace {

constexpr std::uint32_t k_json = 0x4e4f534a;
constexpr std::uint32_t k_binary = 0x004e4942;

struct Chunks {
    std::string_view json;
    std::string_view binary;
    bool has_binary = false;
};

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
    if (at > bytes.size() || bytes.size() - at < 4) throw BadFile("ends within its chunks");
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

std::string_view chunk_at(std::string_view bytes, std::size_t at) {
    const std::size_t size = word_at(bytes, at);
    if (size > bytes.size() - at - 8) throw BadFile("has a chunk that is longer than the file");
    return bytes.substr(at + 8, size);
}

/// The chunks of a binary file. Some programs do not pad the JSON to a multiple of four bytes, or do not
/// count the padding.
Chunks chunks_of(std::string_view bytes) {
    const std::uint32_t version = word_at(bytes, 4);
    if (version != 2)
        throw BadFile(
            fmt::format("is binary glTF of version {}; Candela reads version 2. Convert it with: npx "
                        "gltf-pipeline -i OLD.glb -o NEW.glb",
                        version));
    const std::size_t length = word_at(bytes, 8);
    if (length > bytes.size())
        throw BadFile(fmt::format("is cut off: it should have {} bytes, but has {}", length, bytes.size()));
    bytes = bytes.substr(0, length);
    constexpr std::size_t k_first = 12;
    if (word_at(bytes, k_first + 4) != k_json) throw BadFile("does not begin with a chunk of JSON");
    Chunks chunks{.json = chunk_at(bytes, k_first), .binary = {}};
    const std::size_t end = k_first + 8 + chunks.json.size();
    for (const std::size_t at : {end, (end + 3) / 4 * 4}) {
        if (at + 8 > bytes.size() || word_at(bytes, at + 4) != k_binary) continue;
        chunks.binary = chunk_at(bytes, at);
        chunks.has_binary = true;
        break;
    }
    // Padding with zeros instead of blanks.
    while (chunks.json.ends_with('\0')) chunks.json.remove_suffix(1);
    return chunks;
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

Buffer data_of(std::string_view uri, std::size_t number) {
    const std::size_t comma = uri.find(',');
    try {
        if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64"))
            throw std::invalid_argument("");
        const std::string bytes = candela::target::base64_decoded(uri.substr(comma + 1));
        return Buffer(Array<char>(bytes.begin(), bytes.end()));
    } catch (const std::invalid_argument&) {
        throw BadFile(fmt::format("has a data: URI for buffer {} that is not valid base64", number));
    }
}

Buffer buffer_from(const BufferSource& source, std::size_t number, std::string_view binary,
                   Document& document, const std::filesystem::path& folder, FileScope reach) {
    if (!source.is_needed) return {};
    const auto require_whole = [&](const Buffer& buffer, const std::string& what) {
        if (buffer.bytes.size() < source.length)
            throw BadFile(fmt::format("{} {} bytes, but buffer {} declares {}", what, buffer.bytes.size(),
                                      number, source.length));
    };
    if (!source.uri) {
        Buffer buffer(binary);
        require_whole(buffer, "is cut off: its binary chunk has");
        return buffer;
    }
    if (source.uri->starts_with("data:")) {
        Buffer buffer = data_of(*source.uri, number);
        require_whole(buffer, "is cut off: its data: URI has");
        document.bytes += buffer.bytes.size();
        return buffer;
    }
    const std::string name = decoded_percents(*source.uri);
    const std::filesystem::path path = part_named(name, folder, reach);
    document.files.push_back(path);
    try {
        Buffer buffer(read_file(path));
        require_whole(buffer, "has only");
        document.bytes += buffer.bytes.size();
        return buffer;
    } catch (const BadFile& problem) {
        throw BadFile(fmt::format("names {}, which {}", in_quotes(name), problem.what()));
    }
}

std::string first_line(std::string_view text) {
    std::string line;
    for (const char c : text.substr(0, text.find('\n'))) line += c >= ' ' && c <= '~' ? c : '?';
    return line;
}

}  // namespace

std::string_view Document::view(std::size_t index) const {
    if (index >= model.bufferViews.size()) throw BadFile(fmt::format("has no buffer view {}", index));
    const tinygltf::BufferView& view = model.bufferViews[index];
    if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= buffers.size())
        throw BadFile(fmt::format("has no buffer {}", view.buffer));
    const std::string_view all = buffers[static_cast<std::size_t>(view.buffer)].bytes;
    if (view.byteOffset > all.size() || view.byteLength > all.size() - view.byteOffset)
        throw BadFile(fmt::format("has a buffer view {} that reaches beyond its buffer", index));
    return all.substr(view.byteOffset, view.byteLength);
}

std::size_t Document::add_view(Array<char> content) {
    tinygltf::BufferView view;
    view.buffer = static_cast<int>(buffers.size());
    view.byteLength = content.size();
    buffers.emplace_back(std::move(content));
    model.bufferViews.push_back(std::move(view));
    return model.bufferViews.size() - 1;
}

int Document::add_accessor(Array<char> content, int component_type, int type, std::size_t count) {
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(add_view(std::move(content)));
    accessor.componentType = component_type;
    accessor.type = type;
    accessor.count = count;
    model.accessors.push_back(std::move(accessor));
    return static_cast<int>(model.accessors.size() - 1);
}

Document read_document(std::string_view bytes, const std::filesystem::path& folder, FileScope reach) {
    Chunks chunks{.json = bytes, .binary = {}};
    if (bytes.starts_with("glTF")) chunks = chunks_of(bytes);
    Geometry geometry = geometry_of(chunks.json, chunks.has_binary);

    tinygltf::TinyGLTF loader;
    Document document;
    std::string problems, warnings;
    bool is_read = false;
    try {
        is_read = loader.LoadASCIIFromString(&document.model, &problems, &warnings, geometry.json.data(),
                                             static_cast<unsigned>(geometry.json.size()), "", 0);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& problem) {
        problems = problem.what();
    }
    if (!is_read) throw BadFile("is not valid glTF: " + first_line(problems));
    document.skins = std::move(geometry.skins);
    document.is_hidden = std::move(geometry.is_hidden);
    document.instances = std::move(geometry.instances);
    document.losses = std::move(geometry.losses);
    document.materials = std::move(geometry.materials);
    document.bytes = bytes.size();
    for (const BufferSource& source : geometry.buffers) {
        document.buffers.push_back(
            buffer_from(source, document.buffers.size(), chunks.binary, document, folder, reach));
    }
    decompress(document, geometry.compressed_views);
    decompress(document, geometry.draco_primitives);
    return document;
}

}  // namespace mesh_io::gltf
