#include "mesh_io/gltf/elements.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace mesh_io::gltf {

namespace {

/// As KHR_mesh_quantization defines.
template <class T>
double scaled(const unsigned char* from, bool is_normalized) {
    const double value = load<T>(from);
    return is_normalized ? std::max(value / std::numeric_limits<T>::max(), -1.0) : value;
}

}  // namespace

std::size_t size_of(int component_type) {
    switch (component_type) {
        case k_byte:
        case k_unsigned_byte:
            return 1;
        case k_short:
        case k_unsigned_short:
            return 2;
        case k_unsigned_int:
        case k_float:
            return 4;
        default:
            return 0;
    }
}

double Elements::number(std::size_t i, std::size_t c, bool is_normalized) const {
    const unsigned char* const from = first + i * stride + c * size_of(component_type);
    switch (component_type) {
        case k_byte:
            return scaled<std::int8_t>(from, is_normalized);
        case k_unsigned_byte:
            return scaled<std::uint8_t>(from, is_normalized);
        case k_short:
            return scaled<std::int16_t>(from, is_normalized);
        case k_unsigned_short:
            return scaled<std::uint16_t>(from, is_normalized);
        case k_unsigned_int:
            return scaled<std::uint32_t>(from, is_normalized);
        default:
            return load<float>(from);
    }
}

std::optional<Elements> elements_in(std::string_view view, std::size_t offset,
                                    std::optional<std::size_t> stride, int component_type,
                                    std::size_t components, std::size_t count) {
    const std::size_t element = size_of(component_type) * components;
    const std::size_t step = stride.value_or(element);
    if (step < element || step == 0) return std::nullopt;
    if (count == 0) return Elements{};
    const bool is_there = offset <= view.size() && element <= view.size() - offset &&
                          count - 1 <= (view.size() - offset - element) / step;
    if (!is_there) return std::nullopt;
    return Elements{reinterpret_cast<const unsigned char*>(view.data()) + offset, step, component_type};
}

}  // namespace mesh_io::gltf
