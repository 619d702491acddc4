#include "import/geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "import/vectors.h"

import candela.api;
import candela.geometry;
import candela.plugins;
import candela.util;

namespace fs = std::filesystem;

namespace importing {

namespace {

/// Only the positions, unchecked: out-of-range coordinates can still be moved into range.
class Positions final : public candela::MeshSink {
  public:
    candela::MeshSpans allocate(const candela::MeshLayout& layout) override {
        for (std::vector<float>* const axis : {&x_, &y_, &z_}) axis->resize(layout.vertices);
        indices_.resize(3 * layout.triangles);
        candela::MeshSpans spans{};
        spans.position = {x_.data(), y_.data(), z_.data()};
        spans.indices = indices_;
        // A shape writes everything it has, whether requested or not.
        if (layout.has_normals) spans.normal = spare_.span(layout.vertices);
        spare_groups_.resize(layout.has_smooth_groups ? layout.vertices : 0);
        spans.smooth_group = spare_groups_;
        return spans;
    }

    std::optional<Bounds> bounds(bool is_z_up) const {
        Bounds bounds;
        std::array<std::pair<double, double>, 3> range;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::vector<float>& values = axis == 0 ? x_ : axis == 1 ? y_ : z_;
            if (values.empty()) return std::nullopt;
            const auto [low, high] = std::ranges::minmax(values);
            if (!std::isfinite(low) || !std::isfinite(high)) return std::nullopt;
            range[axis] = {low, high};
        }
        if (is_z_up) range = {range[0], range[2], {-range[1].second, -range[1].first}};
        for (std::size_t axis = 0; axis < 3; ++axis)
            bounds.low[axis] = range[axis].first, bounds.high[axis] = range[axis].second;
        return bounds;
    }

  private:
    struct Spare {
        std::vector<float> x, y, z;
        candela::Vec3Span span(std::size_t count) {
            for (std::vector<float>* const axis : {&x, &y, &z}) axis->resize(count);
            return {x.data(), y.data(), z.data()};
        }
    };

    std::vector<float> x_, y_, z_;
    std::vector<std::uint32_t> indices_, spare_groups_;
    Spare spare_;
};

class Look {
  public:
    Look(const Source& source, bool is_z_up, candela::Registry& registry)
        : is_z_up_(is_z_up),
          registry_(registry),
          parameters_(registry.parameters(candela::PluginKind::shape, "mesh")) {
        parameters_.set("file", fs::absolute(source.file).string());
        parameters_.set("allow_outside", source.allows_outside);
        // The same parameters as in the scene, which then need not read the file again.
        const std::string extension = candela::extension_of(source.file);
        if (extension == "gltf" || extension == "glb") parameters_.set("sides", std::string("both"));
    }

    /// Makes a point of the file's coordinates the origin.
    void set_origin(const std::string& origin) { parameters_.set("origin", origin); }

    Geometry geometry() const {
        std::shared_ptr<candela::Shape> shape = this->shape();
        candela::Transform transform;
        if (is_z_up_) transform.rotation = {-90, 0, 0};
        candela::PlacedShape placed;
        try {
            placed = candela::place(*shape, {.uv = true, .color = true, .normals = false}, transform);
        } catch (const candela::Error&) {
            throw;
        } catch (const std::bad_alloc&) {
            throw;
        } catch (const std::exception& problem) {
            throw candela::Error(candela::ErrorCategory::failure, problem.what());
        }
        const candela::Mesh& mesh = placed.mesh;
        Geometry result;
        result.file = std::move(shape);
        result.has_colors = !mesh.color.empty();
        result.has_uv = !mesh.u.empty();
        result.is_closed = mesh.open_edges == 0;
        const candela::ConstVec3Span position = mesh.position.span();
        const auto grow = [&](std::size_t axis, const float* values) {
            const auto [low, high] = std::minmax_element(values, values + mesh.vertex_count());
            result.bounds.low[axis] = static_cast<double>(*low);
            result.bounds.high[axis] = static_cast<double>(*high);
        };
        grow(0, position.x);
        grow(1, position.y);
        grow(2, position.z);
        result.mesh = std::move(placed.mesh);
        return result;
    }

    std::optional<Bounds> unchecked_bounds() const {
        Positions positions;
        try {
            shape()->tessellate({.normals = false}, positions);
        } catch (const std::bad_alloc&) {
            throw;
        } catch (const std::exception&) {
            return std::nullopt;
        }
        return positions.bounds(is_z_up_);
    }

  private:
    std::unique_ptr<candela::Shape> shape() const {
        return registry_.create<candela::Shape>("mesh", parameters_, candela::ColorEncoding::srgb);
    }

    bool is_z_up_;
    candela::Registry& registry_;
    candela::ParamSet parameters_;
};

/// Up to this many times its size from the origin, single precision keeps a model's form to a
/// hundred-thousandth of it.
constexpr double k_far = 100;

bool is_far(const Bounds& bounds) {
    const Vector center = bounds.center();
    const double farthest = std::max({std::abs(center[0]), std::abs(center[1]), std::abs(center[2])});
    const double size = std::max(bounds.radius(), farthest * double{std::numeric_limits<float>::epsilon()});
    return length(bounds.high - bounds.low) > 0 ? farthest > k_far * size : farthest > k_far;
}

/// Rounded to a power of ten that is at most a hundredth of `size`, so that it has few digits.
Vector rounded(Vector v, double size) {
    const double power = std::floor(std::log10(size)) - 2, step = std::pow(10.0, std::abs(power));
    for (double& x : v) x = power < 0 ? std::round(x * step) / step : std::round(x / step) * step;
    return v;
}

std::string text_of(const Vector& v) { return fmt::format("{} {} {}", v[0] + 0.0, v[1] + 0.0, v[2] + 0.0); }

/// From the scene's axes to the file's.
Vector in_file(const Vector& v, bool is_z_up) { return is_z_up ? Vector{v[0], -v[2], v[1]} : v; }

}  // namespace

Geometry geometry_of(const Source& source, bool is_z_up, candela::Registry& registry) {
    Look look(source, is_z_up, registry);
    Bounds first;
    try {
        const Geometry geometry = look.geometry();
        if (!is_far(geometry.bounds)) return geometry;
        first = geometry.bounds;
    } catch (const candela::Error&) {
        const auto bounds = look.unchecked_bounds();
        if (!bounds || !is_far(*bounds)) throw;
        first = *bounds;
    }
    // These bounds are as rounded as the coordinates. Relative to a near origin, they are exact.
    const Vector near = first.center();
    look.set_origin(text_of(in_file(near, is_z_up)));
    Geometry geometry = look.geometry();
    geometry.moved = rounded(near + geometry.bounds.center(), geometry.bounds.radius());
    geometry.origin = text_of(in_file(geometry.moved, is_z_up));
    geometry.bounds.low = geometry.bounds.low + near - geometry.moved;
    geometry.bounds.high = geometry.bounds.high + near - geometry.moved;
    return geometry;
}

}  // namespace importing
