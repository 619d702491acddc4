#include "mesh_io/gltf/accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace mesh_io::gltf {

Accessor::Accessor(const Document& document, int index, int components) : document_(document), index_(index) {
    const auto& accessors = document.model.accessors;
    if (index < 0 || static_cast<std::size_t>(index) >= accessors.size())
        throw BadFile(fmt::format("has no accessor {}", index));
    const tinygltf::Accessor& a = accessors[static_cast<std::size_t>(index)];
    if (components_of(document, index) != components)
        throw BadFile(fmt::format("has an accessor {} whose type does not fit its use", index));
    if (size_of(a.componentType) == 0)
        throw BadFile(fmt::format("has an accessor {} of component type {}", index, a.componentType));
    // Without a view everything is zero, and the number of zeros costs no bytes.
    if (a.bufferView < 0 && a.count > document.bytes) {
        throw BadFile(fmt::format(
            "has an accessor {} that declares {} elements, more than the file has bytes", index, a.count));
    }
    count_ = a.count;
    normalized_ = a.normalized;
    dense_ = elements(a.bufferView, a.byteOffset, a.componentType, components, count_);
    if (!a.sparse.isSparse) return;
    if (a.sparse.count < 0 || static_cast<std::size_t>(a.sparse.count) > count_)
        throw BadFile(fmt::format("has an accessor {} with more sparse elements than elements", index));
    sparse_count_ = static_cast<std::size_t>(a.sparse.count);
    // An int in tinygltf 2.8, a size_t since 2.9.
    const auto offset = [&](std::int64_t bytes_offset) {
        if (bytes_offset < 0) throw BadFile(fmt::format("has an accessor {} with a negative offset", index));
        return static_cast<std::size_t>(bytes_offset);
    };
    if (a.sparse.indices.bufferView < 0 || a.sparse.values.bufferView < 0)
        throw BadFile(fmt::format("has an accessor {} whose sparse elements have no buffer view", index));
    if (size_of(a.sparse.indices.componentType) == 0 ||
        a.sparse.indices.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT)
        throw BadFile(fmt::format("has an accessor {} whose sparse indices are not integers", index));
    sparse_indices_ = elements(a.sparse.indices.bufferView, offset(a.sparse.indices.byteOffset),
                               a.sparse.indices.componentType, 1, sparse_count_);
    sparse_values_ = elements(a.sparse.values.bufferView, offset(a.sparse.values.byteOffset), a.componentType,
                              components, sparse_count_);
}

Elements Accessor::elements(int view_index, std::size_t offset, int component_type, int components,
                            std::size_t count) const {
    if (view_index < 0) return {};
    const std::string_view data = document_.view(static_cast<std::size_t>(view_index));
    const tinygltf::BufferView& view = document_.model.bufferViews[static_cast<std::size_t>(view_index)];
    const auto numbers = static_cast<std::size_t>(components);
    std::optional<std::size_t> stride;
    if (view.byteStride != 0) stride = view.byteStride;
    if (stride && *stride < size_of(component_type) * numbers)
        throw BadFile(fmt::format("has a buffer view {} whose stride is too short", view_index));
    const auto found = elements_in(data, offset, stride, component_type, numbers, count);
    if (!found) throw BadFile(fmt::format("has an accessor {} that reaches beyond its buffer", index_));
    return *found;
}

int Accessor::components_of(const Document& document, int index) {
    const auto& accessors = document.model.accessors;
    if (index < 0 || static_cast<std::size_t>(index) >= accessors.size()) return 0;
    switch (accessors[static_cast<std::size_t>(index)].type) {
        case TINYGLTF_TYPE_SCALAR:
            return 1;
        case TINYGLTF_TYPE_VEC2:
            return 2;
        case TINYGLTF_TYPE_VEC3:
            return 3;
        case TINYGLTF_TYPE_VEC4:
            return 4;
        case TINYGLTF_TYPE_MAT4:
            return 16;
        default:
            return 0;
    }
}

std::optional<Array<std::uint32_t>> Accessor::whole_numbers() const {
    if (dense_.first == nullptr || sparse_count_ > 0 || normalized_) return std::nullopt;
    Array<std::uint32_t> numbers(count_);
    const auto copy = [&](auto t) {
        for (std::size_t i = 0; i < count_; ++i)
            numbers[i] = load<decltype(t)>(dense_.first + i * dense_.stride);
        return std::optional(std::move(numbers));
    };
    switch (dense_.component_type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return copy(std::uint8_t{});
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return copy(std::uint16_t{});
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return copy(std::uint32_t{});
        default:
            return std::nullopt;
    }
}

Array<double> Accessor::read(int c) const {
    Array<double> values(count_);
    if (dense_.first != nullptr && dense_.component_type == TINYGLTF_COMPONENT_TYPE_FLOAT) {
        const unsigned char* const first = dense_.first + static_cast<std::size_t>(c) * sizeof(float);
        for (std::size_t i = 0; i < count_; ++i) values[i] = double{load<float>(first + i * dense_.stride)};
    } else {
        for (std::size_t i = 0; i < count_; ++i)
            values[i] =
                dense_.first == nullptr ? 0.0 : dense_.number(i, static_cast<std::size_t>(c), normalized_);
    }
    for (std::size_t k = 0; k < sparse_count_; ++k) {
        const auto integer = [&]() -> std::size_t {
            const unsigned char* const from = sparse_indices_.first + k * sparse_indices_.stride;
            switch (size_of(sparse_indices_.component_type)) {
                case 1:
                    return *from;
                case 2:
                    return load<std::uint16_t>(from);
                default:
                    return load<std::uint32_t>(from);
            }
        };
        const std::size_t i = integer();
        if (i >= count_)
            throw BadFile(
                fmt::format("has an accessor {} with a sparse element {} of {}", index_, i, count_));
        values[i] = sparse_values_.number(k, static_cast<std::size_t>(c), normalized_);
    }
    return values;
}

}  // namespace mesh_io::gltf
