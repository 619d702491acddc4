module;

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

module candela.raster;

import :binning;
import :bounds;
import :clipping;
import :culling;
import candela.geometry;

namespace candela {

namespace {

/// Sorts triangles into tiles.
class Binner {
  public:
    /// For at most `count` triangles and their pieces after clipping.
    Binner(const ProjectedScene& scene, std::size_t count, TriangleBin& bin)
        : scene_(scene),
          bin_(bin),
          bounds_(scene),
          tile_bits_(scene.subpixel_bits + std::countr_zero(static_cast<unsigned>(scene.tile_size))),
          column0_(scene.tile_columns),
          row0_(scene.tile_rows) {
        bin_.entries.clear();
        bin_.pieces.clear();
        bin_.columns = bin_.rows = 0;
        kept_.reserve(count);
    }

    /// `first_id`: of the first of `triangles`, whose vertices begin at the scene's `first_vertex`.
    void add(const IndexedTriangles& triangles, std::uint32_t first_vertex, std::uint32_t first_id) {
        Culling culling;
        for (std::size_t first = 0; first < triangles.count; first += Culling::k_size) {
            culling.look_at(triangles, first, bounds_);
            for (std::uint64_t rest = culling.kept | culling.clipped; rest != 0; rest &= rest - 1) {
                const auto i = static_cast<std::size_t>(std::countr_zero(rest));
                const std::uint32_t* const indices = triangles.indices + 3 * (first + i);
                const std::uint32_t id = first_id + static_cast<std::uint32_t>(first + i);
                const std::uint32_t a = first_vertex + indices[0], b = first_vertex + indices[1],
                                    c = first_vertex + indices[2];
                if ((culling.clipped >> i & 1) != 0) {
                    keep_pieces({a, b, c}, id, triangles.two_sided);
                } else {
                    const bool is_back = (culling.reversed >> i & 1) != 0;
                    keep({{a, is_back ? b : c, is_back ? c : b}, id}, culling.left[i], culling.right[i],
                         culling.top[i], culling.bottom[i]);
                }
            }
        }
    }

    void sort_into_tiles() {
        if (kept_.empty()) return;
        bin_.first_column = column0_;
        bin_.first_row = row0_;
        bin_.columns = column1_ - column0_ + 1;
        bin_.rows = row1_ - row0_ + 1;
        // A counting sort keeps a tile's triangles in the scene's order.
        bin_.start.assign(static_cast<std::size_t>(bin_.columns) * static_cast<std::size_t>(bin_.rows) + 1,
                          0);
        const auto each_tile = [&](const Kept& kept, auto&& visit) {
            const auto tile = [&](int column, int row) {
                return static_cast<std::size_t>((row - row0_) * bin_.columns + column - column0_);
            };
            if (kept.is_in_one_tile()) return visit(tile(kept.column0, kept.row0));
            for (int row = kept.row0; row <= kept.row1; ++row) {
                for (int column = kept.column0; column <= kept.column1; ++column) visit(tile(column, row));
            }
        };
        for (const Kept& kept : kept_) {
            each_tile(kept, [&](std::size_t tile) { ++bin_.start[tile + 1]; });
        }
        for (std::size_t tile = 1; tile < bin_.start.size(); ++tile) bin_.start[tile] += bin_.start[tile - 1];
        bin_.entries.resize(bin_.start.back());
        next_.assign(bin_.start.begin(), bin_.start.end() - 1);
        for (const Kept& kept : kept_) {
            each_tile(kept, [&](std::size_t tile) { bin_.entries[next_[tile]++] = kept.triangle; });
        }
    }

  private:
    /// A triangle, and the first and the last of the tiles that it touches.
    struct Kept {
        BinnedTriangle triangle;
        std::int16_t column0, column1, row0, row1;

        bool is_in_one_tile() const { return column0 == column1 && row0 == row1; }
    };

    void keep(const BinnedTriangle& triangle, std::int32_t left, std::int32_t right, std::int32_t top,
              std::int32_t bottom) {
        const std::int32_t column0 = std::max(left, 0) >> tile_bits_;
        const std::int32_t column1 = std::min(right >> tile_bits_, scene_.tile_columns - 1);
        const std::int32_t row0 = std::max(std::max(top, 0) >> tile_bits_, scene_.seen_rows.first);
        const std::int32_t row1 = std::min(bottom >> tile_bits_, scene_.seen_rows.end - 1);
        if (row0 > row1) return;
        column0_ = std::min(column0_, column0);
        column1_ = std::max(column1_, column1);
        row0_ = std::min(row0_, row0);
        row1_ = std::max(row1_, row1);
        kept_.push_back({triangle, static_cast<std::int16_t>(column0), static_cast<std::int16_t>(column1),
                         static_cast<std::int16_t>(row0), static_cast<std::int16_t>(row1)});
    }

    void keep_pieces(const std::array<std::uint32_t, 3>& vertices, std::uint32_t id, bool two_sided) {
        std::size_t piece = bin_.pieces.size();
        clip(scene_, vertices, id, two_sided, bin_.pieces);
        for (; piece < bin_.pieces.size(); ++piece) {
            const auto& [a, b, c] = bin_.pieces[piece].vertex;
            keep({{BinnedTriangle::k_piece, static_cast<std::uint32_t>(piece), 0}, id}, least(a.x, b.x, c.x),
                 most(a.x, b.x, c.x), least(a.y, b.y, c.y), most(a.y, b.y, c.y));
        }
    }

    const ProjectedScene& scene_;
    TriangleBin& bin_;
    SampleBounds bounds_;
    int tile_bits_;
    int column0_, column1_ = -1, row0_, row1_ = -1;  // of all tiles touched
    std::vector<Kept> kept_;
    std::vector<std::uint32_t> next_;
};

}  // namespace

void bin_triangles(const ProjectedScene& scene, std::span<const Mesh* const> meshes, std::size_t first_id,
                   std::size_t count, TriangleBin& bin) {
    Binner binner(scene, count, bin);
    const std::size_t end_id = first_id + count;
    const auto& first = scene.first_triangle;
    auto m = static_cast<std::size_t>(std::ranges::upper_bound(first, first_id) - first.begin() - 1);
    for (std::size_t id = first_id; id < end_id; ++m) {
        const std::size_t end = std::min<std::size_t>(first[m + 1], end_id);
        const Mesh& mesh = *meshes[m];
        binner.add({.indices = mesh.indices.data() + 3 * (id - first[m]),
                    .screen = scene.screen.data() + scene.first_vertex[m],
                    .count = end - id,
                    .two_sided = !mesh.closed},
                   scene.first_vertex[m], static_cast<std::uint32_t>(id));
        id = end;
    }
    binner.sort_into_tiles();
}

}  // namespace candela
