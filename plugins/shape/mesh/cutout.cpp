#include "cutout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace mesh {

namespace {

/// A corner of a piece of a triangle: where it is in the picture, in pixels, and within the triangle.
struct Corner {
    double x = 0, y = 0;
    std::array<double, 3> weight{};  // of the triangle's corners
};

// A triangle that is cut by a square and by an outline has at most eight.
using Piece = std::vector<Corner>;

/// The part of a convex piece where `distance`, which is linear, is not negative.
template <class Distance>
Piece clipped(const Piece& piece, Distance distance) {
    Piece result;
    for (std::size_t i = 0; i < piece.size(); ++i) {
        const Corner &a = piece[i], &b = piece[(i + 1) % piece.size()];
        const double da = distance(a), db = distance(b);
        if (da >= 0) result.push_back(a);
        if ((da >= 0) == (db >= 0)) continue;
        const double t = da / (da - db);
        Corner cut{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
        for (std::size_t k = 0; k < 3; ++k) cut.weight[k] = a.weight[k] + t * (b.weight[k] - a.weight[k]);
        result.push_back(cut);
    }
    return result.size() < 3 ? Piece() : result;
}

/// Squares between the centres of pixels, joined four by four up to a single one: a square that lies entirely
/// inside or outside needs no cutting.
class Squares {
  public:
    Squares(const Opacity& opacity, float level, bool clamps)
        : opacity_(opacity), level_(level), clamps_(clamps) {
        Level first{opacity.width(), opacity.height(), {}};
        for (int y = 0; y < first.height; ++y)
            for (int x = 0; x < first.width; ++x) {
                const float a = value(x, y), b = value(x + 1, y), c = value(x, y + 1),
                            d = value(x + 1, y + 1);
                first.ranges.push_back({std::min({a, b, c, d}), std::max({a, b, c, d})});
            }
        levels_.push_back(std::move(first));
        while (levels_.back().width > 1 || levels_.back().height > 1) {
            const Level& fine = levels_.back();
            Level coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}};
            for (int y = 0; y < coarse.height; ++y)
                for (int x = 0; x < coarse.width; ++x) {
                    Range range = fine.at(2 * x, 2 * y);
                    for (const auto& [i, j] : {std::pair{1, 0}, std::pair{0, 1}, std::pair{1, 1}}) {
                        if (2 * x + i >= fine.width || 2 * y + j >= fine.height) continue;
                        const Range more = fine.at(2 * x + i, 2 * y + j);
                        range = {std::min(range.low, more.low), std::max(range.high, more.high)};
                    }
                    coarse.ranges.push_back(range);
                }
            levels_.push_back(std::move(coarse));
        }
    }

    /// Passes the parts of a triangle that lie inside to `take`.
    template <class Take>
    void cut(const Piece& triangle, Take take) const {
        const auto tiles = [](double low, double high, int size) {
            return std::pair{std::floor(low / size), std::floor(high / size)};
        };
        const auto [left, right] = std::ranges::minmax(triangle, {}, &Corner::x);
        const auto [top, bottom] = std::ranges::minmax(triangle, {}, &Corner::y);
        const auto [first_x, last_x] = tiles(left.x, right.x, opacity_.width());
        const auto [first_y, last_y] = tiles(top.y, bottom.y, opacity_.height());
        constexpr double k_most_tiles = 256;
        if (!((last_x - first_x + 1) * (last_y - first_y + 1) <= k_most_tiles)) return take(triangle);
        const int across = static_cast<int>(last_x - first_x) + 1,
                  down = static_cast<int>(last_y - first_y) + 1;
        for (int j = 0; j < down; ++j)
            for (int i = 0; i < across; ++i)
                cut(triangle, levels_.size() - 1, 0, 0, (first_x + i) * opacity_.width(),
                    (first_y + j) * opacity_.height(), take);
    }

  private:
    struct Range {
        float low, high;
    };
    struct Level {
        int width, height;
        std::vector<Range> ranges;

        Range at(int x, int y) const {
            return ranges[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                          static_cast<std::size_t>(x)];
        }
    };

    float value(int x, int y) const { return opacity_.at(x, y, clamps_); }

    /// The part of `piece` in square (x, y) of a level, of the tile that begins at (tile_x, tile_y).
    template <class Take>
    void cut(Piece piece, std::size_t level, int x, int y, double tile_x, double tile_y, Take take) const {
        const double size = std::ldexp(1.0, static_cast<int>(level));
        const double left = tile_x + x * size,
                     right = tile_x + std::min((x + 1) * size, static_cast<double>(opacity_.width()));
        const double top = tile_y + y * size,
                     bottom = tile_y + std::min((y + 1) * size, static_cast<double>(opacity_.height()));
        piece = clipped(piece, [&](const Corner& c) { return c.x - left; });
        piece = clipped(piece, [&](const Corner& c) { return right - c.x; });
        piece = clipped(piece, [&](const Corner& c) { return c.y - top; });
        piece = clipped(piece, [&](const Corner& c) { return bottom - c.y; });
        if (piece.empty()) return;
        const Range range = levels_[level].at(x, y);
        if (range.low >= level_) return take(piece);
        if (range.high < level_) return;
        if (level == 0) return cut_square(piece, x, y, left, top, take);
        const Level& fine = levels_[level - 1];
        for (int j = 2 * y; j < std::min(2 * y + 2, fine.height); ++j)
            for (int i = 2 * x; i < std::min(2 * x + 2, fine.width); ++i)
                cut(piece, level - 1, i, j, tile_x, tile_y, take);
    }

    /// Cuts between four pixels, with two triangles in which the opacity is linear.
    template <class Take>
    void cut_square(const Piece& piece, int x, int y, double left, double top, Take take) const {
        const double a = value(x, y), b = value(x + 1, y), c = value(x, y + 1), d = value(x + 1, y + 1);
        const auto side = [&](const Corner& p) { return (p.x - left) - (p.y - top); };
        const auto take_within = [&](const Piece& half, double by_x, double by_y) {
            const Piece within = clipped(half, [&](const Corner& p) {
                return a + (p.x - left) * by_x + (p.y - top) * by_y - static_cast<double>(level_);
            });
            if (!within.empty()) take(within);
        };
        take_within(clipped(piece, side), b - a, d - b);
        take_within(clipped(piece, [&](const Corner& p) { return -side(p); }), d - c, c - a);
    }

    const Opacity& opacity_;
    float level_;
    bool clamps_;
    std::vector<Level> levels_;
};

class Cutter {
  public:
    explicit Cutter(const mesh_io::Surface& from) : from_(from) {
        result_.is_color_linear = from.is_color_linear;
        result_.losses = from.losses;
        result_.notes = from.notes;
        for (const mesh_io::Attribute& attribute : from.attributes)
            result_.attributes.push_back(
                {attribute.name, std::vector<mesh_io::Array<float>>(attribute.channels.size())});
    }

    /// Returns nothing if there would be more than `most` triangles.
    std::optional<mesh_io::Surface> cut(const Opacity& opacity, float level, bool clamps, std::size_t most) {
        const Squares squares(opacity, level, clamps);
        for (std::size_t t = 0; t < from_.triangles(); ++t) {
            Piece triangle(3);
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t v = from_.indices[3 * t + k];
                triangle[k].x = static_cast<double>(from_.u[v]) * opacity.width() - 0.5;
                triangle[k].y = (1 - static_cast<double>(from_.v[v])) * opacity.height() - 0.5;
                triangle[k].weight[k] = 1;
            }
            squares.cut(triangle, [&](const Piece& piece) { add(piece, t); });
            if (result_.triangles() > most) return std::nullopt;
        }
        return std::move(result_);
    }

  private:
    void add(const Piece& piece, std::size_t triangle) {
        const auto first = static_cast<std::uint32_t>(result_.position.size());
        for (const Corner& corner : piece) {
            const auto mean = [&](const mesh_io::Array<float>& values) {
                double sum = 0;
                for (std::size_t k = 0; k < 3; ++k)
                    sum += corner.weight[k] * static_cast<double>(values[from_.indices[3 * triangle + k]]);
                return static_cast<float>(sum);
            };
            const auto add_mean = [&](const mesh_io::Vectors& values, mesh_io::Vectors& to) {
                if (!values.empty()) to.push_back({mean(values.x), mean(values.y), mean(values.z)});
            };
            add_mean(from_.position, result_.position);
            add_mean(from_.normal, result_.normal);
            add_mean(from_.tangent, result_.tangent);
            if (!from_.tangent_side.empty())
                result_.tangent_side.push_back(mean(from_.tangent_side) < 0 ? -1.0f : 1.0f);
            add_mean(from_.color, result_.color);
            for (std::size_t a = 0; a < from_.attributes.size(); ++a)
                for (std::size_t c = 0; c < from_.attributes[a].channels.size(); ++c)
                    result_.attributes[a].channels[c].push_back(mean(from_.attributes[a].channels[c]));
            result_.u.push_back(mean(from_.u));
            result_.v.push_back(mean(from_.v));
        }
        for (std::uint32_t i = 1; i + 1 < piece.size(); ++i) {
            for (const std::uint32_t corner : {0u, i, i + 1}) result_.indices.push_back(first + corner);
            if (!from_.facet_normal.empty())
                result_.facet_normal.push_back(from_.facet_normal.span()[triangle]);
            if (!from_.smoothing.empty()) result_.smoothing.push_back(from_.smoothing[triangle]);
        }
    }

    const mesh_io::Surface& from_;
    mesh_io::Surface result_;
};

}  // namespace

Opacity Opacity::read(std::string_view pgm) {
    std::array<int, 3> header{};  // width, height, the largest value
    const char* at = pgm.data() + 2;
    const char* const end = pgm.data() + pgm.size();
    bool is_pgm = pgm.starts_with("P5");
    for (int& number : header) {
        while (is_pgm && at < end && (*at == ' ' || *at == '\n')) ++at;
        if (!is_pgm) break;
        const auto [rest, problem] = std::from_chars(at, end, number);
        is_pgm = problem == std::errc() && number > 0;
        at = rest;
    }
    constexpr int k_most = 4096;
    const auto pixels = static_cast<std::size_t>(header[0]) * static_cast<std::size_t>(header[1]);
    is_pgm = is_pgm && header[0] <= k_most && header[1] <= k_most && header[2] == 255 && at < end &&
             static_cast<std::size_t>(end - at - 1) >= pixels;
    if (!is_pgm)
        throw mesh_io::BadFile(fmt::format("is not an 8-bit binary PGM of at most {0} x {0} pixels", k_most));
    ++at;
    Opacity result;
    result.width_ = header[0];
    result.height_ = header[1];
    for (std::size_t i = 0; i < pixels; ++i)
        result.values_.push_back(static_cast<float>(static_cast<unsigned char>(at[i])) / 255);
    return result;
}

float Opacity::at(int x, int y, bool clamps) const {
    const auto within = [&](int i, int size) {
        return clamps ? std::clamp(i, 0, size - 1) : (i % size + size) % size;
    };
    return values_[static_cast<std::size_t>(within(y, height_)) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(within(x, width_))];
}

Opacity Opacity::halved() const {
    Opacity result;
    result.width_ = std::max(width_ / 2, 1);
    result.height_ = std::max(height_ / 2, 1);
    for (int y = 0; y < result.height_; ++y)
        for (int x = 0; x < result.width_; ++x)
            result.values_.push_back((at(2 * x, 2 * y, true) + at(2 * x + 1, 2 * y, true) +
                                      at(2 * x, 2 * y + 1, true) + at(2 * x + 1, 2 * y + 1, true)) /
                                     4);
    return result;
}

mesh_io::Surface cut_out(const mesh_io::Surface& surface, const Opacity& opacity, float level, bool clamps) {
    if (surface.u.empty()) return surface;
    const std::size_t most = std::max<std::size_t>(std::size_t{1} << 21, 2 * surface.triangles());
    Opacity finest = opacity;
    for (bool is_coarser = false;; is_coarser = true) {
        std::optional<mesh_io::Surface> result = Cutter(surface).cut(finest, level, clamps, most);
        if (!result && finest.width() * finest.height() > 1) {
            finest = finest.halved();
            continue;
        }
        if (!result) return surface;
        if (result->triangles() == 0) throw mesh_io::BadFile("is transparent everywhere");
        if (is_coarser)
            result->notes.emplace_back(fmt::format(
                "would have too many triangles along its cut-outs, so these were coarsened to {} x {} pixels",
                finest.width(), finest.height()));
        return std::move(*result);
    }
}

}  // namespace mesh
