// tinygltf is compiled here and nowhere else: with exceptions, and without images.
#define TINYGLTF_IMPLEMENTATION
#include "mesh_io/gltf/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "mesh_io/file_bytes.h"
#include "mesh_io/gltf/container.h"
#include "mesh_io/gltf/draco.h"
#include "mesh_io/gltf/json.h"
#include "mesh_io/gltf/meshopt.h"
#include "mesh_io/surface.h"
#include "mesh_io/text_scanner.h"

namespace mesh_io::gltf {

namespace {

Buffer data_buffer(std::string_view uri, std::size_t number) {
    if (auto bytes = bytes_of_data_uri(uri)) return Buffer(*std::move(bytes));
    throw BadFile(fmt::format("has a data: URI for buffer {} that is not valid base64", number));
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
        Buffer buffer = data_buffer(*source.uri, number);
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

Document read_document(std::string_view bytes, const std::filesystem::path& folder, FileScope reach,
                       Attributes attributes) {
    const auto part = [&](std::size_t begin, std::size_t count) { return bytes.substr(begin, count); };
    const Chunks chunks = chunks_of(bytes.size(), part);
    Geometry geometry = geometry_of(part(chunks.json.begin, chunks.json.size), chunks.has_binary, attributes);
    const std::string_view binary = part(chunks.binary.begin, chunks.binary.size);

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
            buffer_from(source, document.buffers.size(), binary, document, folder, reach));
    }
    decompress(document, geometry.compressed_views);
    decompress(document, geometry.draco_primitives);
    return document;
}

}  // namespace mesh_io::gltf
