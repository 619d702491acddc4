// The numbers of an accessor within its buffer view.
#pragma once

#include <cstddef>
#include <cstring>
#include <optional>
#include <string_view>

namespace mesh_io::gltf {

/// The types of numbers (glTF 2.0, 3.6.2.2).
enum ComponentType : int {
    k_byte = 5120,
    k_unsigned_byte = 5121,
    k_short = 5122,
    k_unsigned_short = 5123,
    k_unsigned_int = 5125,
    k_float = 5126
};

/// In bytes; 0 for a number that is not a component type.
std::size_t size_of(int component_type);

/// Elements of one component type in a buffer view.
struct Elements {
    const unsigned char* first = nullptr;  // null: all zero
    std::size_t stride = 0;                // in bytes
    int component_type = 0;

    /// Component `c` of element `i`. A normalized integer is a fraction of the largest.
    double number(std::size_t i, std::size_t c, bool is_normalized) const;
};

/// `count` elements from `offset` on; without a stride they are contiguous. Nothing if they are not within
/// the view.
std::optional<Elements> elements_in(std::string_view view, std::size_t offset,
                                    std::optional<std::size_t> stride, int component_type,
                                    std::size_t components, std::size_t count);

template <class T>
T load(const unsigned char* from) {
    T value;
    std::memcpy(&value, from, sizeof value);
    return value;
}

}  // namespace mesh_io::gltf
