// tinygltf is compiled here and nowhere else: with exceptions, and without images.
#define TINYGLTF_IMPLEMENTATION
#include "gltf_document.h"

#include <fmt/format.h>

#include <cstring>

#include "file_bytes.h"
#include "gltf_json.h"
#include "surface.h"
#include "text_scanner.h"

namespace mesh::gltf {

namespace {

constexpr std::uint32_t k_magic = 0x46546c67;  // "glTF"
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

/// Of a binary file. Some programs do not pad the JSON to a multiple of four bytes, or pad it and do not
/// count that.
Chunks chunks_of(std::string_view bytes) {
    const std::uint32_t version = word_at(bytes, 4);
    if (version != 2)
        throw BadFile(fmt::format("is binary glTF of version {}; Candela reads version 2", version));
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

/// A container for tinygltf, padded as the standard demands.
std::string container_of(const std::string& json, std::string_view binary) {
    const auto padded = [](std::size_t size) { return (size + 3) / 4 * 4; };
    const std::size_t json_size = padded(json.size()), binary_size = padded(binary.size());
    const std::size_t size = 20 + json_size + 8 + binary_size;
    constexpr std::size_t k_most = 0xffff'ffffu;
    if (size > k_most) throw BadFile("has more than 4 GB");
    std::string container;
    container.reserve(size);
    const auto word = [&](std::size_t value) {
        for (int shift = 0; shift < 32; shift += 8) container += static_cast<char>(value >> shift & 0xff);
    };
    for (const std::size_t value :
         {std::size_t{k_magic}, std::size_t{2}, size, json_size, std::size_t{k_json}})
        word(value);
    container += json;
    container.append(json_size - json.size(), ' ');
    word(binary_size);
    word(k_binary);
    container += binary;
    container.append(binary_size - binary.size(), '\0');
    return container;
}

/// The files that tinygltf may look at.
struct Files {
    std::filesystem::path folder;
    Reach reach;
    std::string problem{};  // the first
};

bool read_buffer(std::vector<unsigned char>* out, std::string*, const std::string& name, void* of) {
    auto& files = *static_cast<Files*>(of);
    try {
        const std::filesystem::path path = part_named(name, files.folder, files.reach);
        try {
            const Array<char> bytes = read_file(path);
            out->assign(bytes.begin(), bytes.end());
        } catch (const BadFile& problem) {
            throw BadFile(fmt::format("names {}, which {}", in_quotes(name), problem.what()));
        }
    } catch (const std::exception& problem) {
        if (files.problem.empty()) files.problem = problem.what();
        return false;
    }
    return true;
}

/// tinygltf 2.9 leaves its own in place, which read any file, where one is missing; 2.8 does not ask for
/// sizes.
template <class Callbacks>
Callbacks callbacks_for(Files& files) {
    Callbacks callbacks{};
    callbacks.FileExists = [](const std::string&, void*) { return true; };
    callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
    callbacks.ReadWholeFile = read_buffer;
    callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&,
                                  void*) { return false; };
    // read_file() has limits of its own.
    if constexpr (requires { callbacks.GetFileSizeInBytes; }) {
        callbacks.GetFileSizeInBytes = [](std::size_t* size, std::string*, const std::string&, void*) {
            *size = 0;
            return true;
        };
    }
    callbacks.user_data = &files;
    return callbacks;
}

std::string first_line(std::string_view text) {
    std::string line;
    for (const char c : text.substr(0, text.find('\n'))) line += c >= ' ' && c <= '~' ? c : '?';
    return line;
}

}  // namespace

Document read_document(std::string_view bytes, const std::filesystem::path& folder, Reach reach) {
    Chunks chunks{.json = bytes, .binary = {}};
    const bool is_binary = bytes.starts_with("glTF");
    if (is_binary) chunks = chunks_of(bytes);
    Geometry geometry = geometry_of(chunks.json, chunks.has_binary);

    Files files{folder, reach};
    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks(callbacks_for<tinygltf::FsCallbacks>(files));
    Document document;
    std::string problems, warnings;
    bool is_read = false;
    try {
        if (chunks.has_binary) {
            const std::string container = container_of(geometry.json, chunks.binary);
            is_read = loader.LoadBinaryFromMemory(&document.model, &problems, &warnings,
                                                  reinterpret_cast<const unsigned char*>(container.data()),
                                                  static_cast<unsigned>(container.size()), "", 0);
        } else {
            is_read = loader.LoadASCIIFromString(&document.model, &problems, &warnings, geometry.json.data(),
                                                 static_cast<unsigned>(geometry.json.size()), "", 0);
        }
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& problem) {
        problems = problem.what();
    }
    if (!files.problem.empty()) throw BadFile(files.problem);
    if (!is_read) throw BadFile("is no valid glTF: " + first_line(problems));
    document.losses = std::move(geometry.losses);
    document.materials = std::move(geometry.materials);
    document.bytes = bytes.size();
    for (const tinygltf::Buffer& buffer : document.model.buffers) document.bytes += buffer.data.size();
    return document;
}

}  // namespace mesh::gltf
