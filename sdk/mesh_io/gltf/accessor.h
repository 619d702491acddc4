// Reads numbers from the accessors of a glTF file.
#pragma once

#include <cstdint>
#include <optional>

#include "mesh_io/gltf/document.h"
#include "mesh_io/gltf/elements.h"
#include "mesh_io/surface.h"

namespace mesh_io::gltf {

/// An accessor whose bytes are known to exist, so that read() cannot fail.
class Accessor {
  public:
    /// Throws BadFile unless accessor `index` has `components` numbers per element, in views that
    /// lie within their buffers.
    Accessor(const Document& document, int index, int components);

    std::size_t count() const { return count_; }

    /// The components per element of an existing accessor: 1 to 4, or 16; 0 for other types.
    static int components_of(const Document& document, int index);
    /// Component `c` of all elements.
    Array<double> read(int c) const;
    /// The only component of all elements, if they are contiguous integers.
    std::optional<Array<std::uint32_t>> whole_numbers() const;

  private:
    Elements elements(int view, std::size_t offset, int component_type, int components,
                      std::size_t count) const;

    const Document& document_;
    int index_;
    std::size_t count_ = 0;
    bool normalized_ = false;
    Elements dense_;
    std::size_t sparse_count_ = 0;
    Elements sparse_indices_, sparse_values_;
};

}  // namespace mesh_io::gltf
