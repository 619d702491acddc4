// The header of a PLY file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mesh_io::ply {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// In bytes.
std::size_t size_of(Type type);
bool is_integer(Type type);
/// Its name in headers.
std::string_view name_of(Type type);

struct Property {
    std::string name;
    Type type = Type::float32;        // for a list: of its items
    std::optional<Type> length_type;  // of a list

    bool is_list() const { return length_type.has_value(); }
};

struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;

    bool has_lists() const;
    /// The bytes of one element without its lists' items.
    std::size_t fixed_size() const;
    /// The index of the first property of one of these names; nothing if there is none.
    std::optional<std::size_t> find(std::initializer_list<std::string_view> names) const;
};

enum class Encoding { text, little_endian, big_endian };

struct Header {
    Encoding encoding = Encoding::text;
    std::vector<Element> elements;
    std::vector<std::string> comments;  // without the keyword and surrounding blanks
    std::size_t size = 0;               // bytes, with the end of its last line
    std::size_t lines = 0;              // of text
};

/// Throws BadFile if the header is invalid, or declares more elements than the remaining bytes can hold.
Header read_header(std::string_view bytes);
/// Reads only the file's beginning: of a file of `file_size` bytes, the header is in `bytes`.
Header read_header(std::string_view bytes, std::size_t file_size);

/// The pictures that MeshLab names in comments.
std::vector<std::string> texture_files(const Header& header);

}  // namespace mesh_io::ply
