#include "grid_shape.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace candela::cpp_target {

namespace {

std::vector<std::uint32_t> groups_of(const GridShape& grid) {
    const int width = grid.columns + 1;
    std::vector<std::uint32_t> groups;
    for (int row = 0; row <= grid.rows; ++row) {
        for (int column = 0; column <= grid.columns; ++column) {
            const bool is_pole = grid.v_ends_in_poles && (row == 0 || row == grid.rows);
            const int as_row = grid.v_is_periodic && row == grid.rows ? 0 : row;
            const int as_column = is_pole || (grid.u_is_periodic && column == grid.columns) ? 0 : column;
            groups.push_back(static_cast<std::uint32_t>(as_row * width + as_column));
        }
    }
    return groups;
}

std::vector<std::uint32_t> indices_of(const GridShape& grid) {
    std::vector<std::uint32_t> indices;
    const auto width = static_cast<std::uint32_t>(grid.columns) + 1;
    for (int row = 0; row < grid.rows; ++row) {
        for (int column = 0; column < grid.columns; ++column) {
            const std::uint32_t a =
                static_cast<std::uint32_t>(row) * width + static_cast<std::uint32_t>(column);
            const std::uint32_t b = a + 1, c = b + width, d = a + width;
            const bool starts_in_pole = grid.v_ends_in_poles && row == 0;
            const bool ends_in_pole = grid.v_ends_in_poles && row + 1 == grid.rows;
            if (!starts_in_pole) indices.insert(indices.end(), {a, b, ends_in_pole ? d : c});
            if (!ends_in_pole) indices.insert(indices.end(), {starts_in_pole ? b : a, c, d});
        }
    }
    return indices;
}

/// Rows begin where u falls back.
std::optional<GridShape> size_of(const ExportedMesh& mesh) {
    if (!mesh.uv) return std::nullopt;
    const float* const u = mesh.uv.x;
    const std::size_t count = mesh.vertex_count;
    std::size_t width = 1;
    while (width < count && u[width] > u[width - 1]) ++width;
    if (width < 2 || count % width != 0 || count / width < 2) return std::nullopt;
    return GridShape{.columns = static_cast<int>(width - 1), .rows = static_cast<int>(count / width - 1)};
}

}  // namespace

std::optional<GridShape> grid_of(const ExportedMesh& mesh) {
    const auto size = size_of(mesh);
    if (!size || mesh.authored_normal) return std::nullopt;
    for (const bool has_poles : {false, true}) {
        for (const bool u_is_periodic : {false, true}) {
            for (const bool v_is_periodic : {false, true}) {
                GridShape grid = *size;
                grid.u_is_periodic = u_is_periodic;
                grid.v_is_periodic = v_is_periodic;
                grid.v_ends_in_poles = has_poles;
                const bool is_closed = u_is_periodic && (v_is_periodic || has_poles);
                if (is_closed == mesh.closed && std::ranges::equal(groups_of(grid), mesh.smooth_group) &&
                    std::ranges::equal(indices_of(grid), mesh.indices))
                    return grid;
            }
        }
    }
    return std::nullopt;
}

}  // namespace candela::cpp_target
