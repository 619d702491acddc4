#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <ranges>
#include <utility>

#include "gltf_accessor.h"
#include "gltf_document.h"
#include "readers.h"

namespace mesh {

namespace gltf {

namespace {

/// The upper three rows of a transformation; columns.
struct Affine {
    std::array<std::array<double, 3>, 4> column = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}};

    std::array<double, 3> linear(std::array<double, 3> v) const {
        std::array<double, 3> r{};
        for (std::size_t row = 0; row < 3; ++row)
            for (std::size_t c = 0; c < 3; ++c) r[row] += column[c][row] * v[c];
        return r;
    }
    std::array<double, 3> point(std::array<double, 3> v) const {
        std::array<double, 3> r = linear(v);
        for (std::size_t row = 0; row < 3; ++row) r[row] += column[3][row];
        return r;
    }
    /// Normals are transformed by its cofactors: the inverse transposed, but for a factor.
    Affine cofactors() const {
        Affine r;
        for (std::size_t c = 0; c < 3; ++c) {
            const auto &a = column[(c + 1) % 3], &b = column[(c + 2) % 3];
            r.column[c] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
        }
        return r;
    }
    double determinant() const {
        const auto n = cofactors().column[0];
        return n[0] * column[0][0] + n[1] * column[0][1] + n[2] * column[0][2];
    }
};

Affine operator*(const Affine& a, const Affine& b) {
    Affine r;
    for (std::size_t c = 0; c < 3; ++c) r.column[c] = a.linear(b.column[c]);
    r.column[3] = a.point(b.column[3]);
    return r;
}

Affine transformation_of(const tinygltf::Node& node) {
    Affine r;
    if (node.matrix.size() == 16) {
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t row = 0; row < 3; ++row) r.column[c][row] = node.matrix[4 * c + row];
        return r;
    }
    if (node.rotation.size() == 4) {
        const double x = node.rotation[0], y = node.rotation[1], z = node.rotation[2], w = node.rotation[3];
        r.column[0] = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)};
        r.column[1] = {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)};
        r.column[2] = {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)};
    }
    if (node.scale.size() == 3)
        for (std::size_t c = 0; c < 3; ++c)
            for (double& v : r.column[c]) v *= node.scale[c];
    if (node.translation.size() == 3)
        r.column[3] = {node.translation[0], node.translation[1], node.translation[2]};
    return r;
}

struct Placed {
    const tinygltf::Primitive* primitive;
    Affine to_world;
};

/// The primitives that the scene shows.
class Walk {
  public:
    explicit Walk(const tinygltf::Model& model) : model_(model), seen_(model.nodes.size()) {
        if (!model.scenes.empty()) {
            const int scene = model.defaultScene < 0 ? 0 : model.defaultScene;
            if (static_cast<std::size_t>(scene) >= model.scenes.size())
                throw BadFile(fmt::format("has no scene {}", scene));
            walk(model.scenes[static_cast<std::size_t>(scene)].nodes);
        } else if (!model.nodes.empty()) {
            std::vector<bool> is_child(model.nodes.size());
            for (const tinygltf::Node& node : model.nodes)
                for (const int child : node.children) is_child[node_at(child)] = true;
            std::vector<int> roots;
            for (std::size_t i = 0; i < is_child.size(); ++i)
                if (!is_child[i]) roots.push_back(static_cast<int>(i));
            walk(roots);
        } else {
            for (const tinygltf::Mesh& mesh : model.meshes) add(mesh, {});
        }
    }

    std::vector<Placed> placed;

  private:
    std::size_t node_at(int index) const {
        if (index < 0 || static_cast<std::size_t>(index) >= model_.nodes.size())
            throw BadFile(fmt::format("has no node {}", index));
        return static_cast<std::size_t>(index);
    }

    void walk(const std::vector<int>& roots) {
        std::vector<std::pair<int, Affine>> open;
        for (const int root : std::views::reverse(roots)) open.emplace_back(root, Affine{});
        while (!open.empty()) {
            const auto [index, parent] = open.back();
            open.pop_back();
            const std::size_t at = node_at(index);
            if (seen_[at]) throw BadFile(fmt::format("has a node {} in two places, or within itself", index));
            seen_[at] = true;
            const tinygltf::Node& node = model_.nodes[at];
            const Affine to_world = parent * transformation_of(node);
            if (node.mesh >= 0) {
                if (static_cast<std::size_t>(node.mesh) >= model_.meshes.size())
                    throw BadFile(fmt::format("has no mesh {}", node.mesh));
                add(model_.meshes[static_cast<std::size_t>(node.mesh)], to_world);
            }
            for (const int child : std::views::reverse(node.children)) open.emplace_back(child, to_world);
        }
    }

    void add(const tinygltf::Mesh& mesh, const Affine& to_world) {
        for (const tinygltf::Primitive& primitive : mesh.primitives) {
            const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
            if (mode < TINYGLTF_MODE_TRIANGLES) continue;  // points and lines
            if (mode > TINYGLTF_MODE_TRIANGLE_FAN)
                throw BadFile(fmt::format("has a primitive of mode {}", mode));
            if (!primitive.attributes.contains("POSITION")) continue;
            placed.push_back({&primitive, to_world});
        }
    }

    const tinygltf::Model& model_;
    std::vector<bool> seen_;
};

class Reader {
  public:
    Reader(Document document, const Origin& origin) : document_(std::move(document)), origin_(origin) {}

    Surface read() {
        const Walk walk(document_.model);
        check_counts(walk.placed);
        surface_.materials = std::move(document_.materials);
        for (const Placed& placed : walk.placed) {
            add(placed);
            surface_.material.resize(surface_.triangles(), material_of(*placed.primitive));
        }
        surface_.losses = std::move(document_.losses);
        surface_.is_color_linear = true;
        if (has_opacity_) surface_.losses.emplace_back("the opacity of vertices");
        return std::move(surface_);
    }

  private:
    Accessor accessor(int index, int components) const { return {document_, index, components}; }

    std::uint32_t material_of(const tinygltf::Primitive& primitive) {
        const std::size_t count = no_material_.value_or(surface_.materials.size());
        if (primitive.material >= 0 && static_cast<std::size_t>(primitive.material) < count)
            return static_cast<std::uint32_t>(primitive.material);
        if (!no_material_) {
            no_material_ = static_cast<std::uint32_t>(surface_.materials.size());
            surface_.materials.emplace_back(k_no_material);
        }
        return *no_material_;
    }

    /// Nodes and primitives may share accessors: a small file can describe any number of triangles.
    void check_counts(const std::vector<Placed>& placed) {
        std::uint64_t numbers = 0;
        bool all_normals = true, any_uv = false, any_color = false;
        for (const Placed& one : placed) {
            const auto& attributes = one.primitive->attributes;
            numbers += accessor(attributes.at("POSITION"), 3).count();
            if (one.primitive->indices >= 0) numbers += accessor(one.primitive->indices, 1).count();
            all_normals = all_normals && attributes.contains("NORMAL");
            any_uv = any_uv || attributes.contains("TEXCOORD_0");
            any_color = any_color || attributes.contains("COLOR_0");
            constexpr std::uint64_t k_most_repeated = std::uint64_t{1} << 24;
            if (numbers > std::max<std::uint64_t>(k_most_repeated, document_.bytes)) {
                throw BadFile(fmt::format("repeats its {} bytes to more than {} vertices and corners",
                                          document_.bytes, k_most_repeated));
            }
        }
        has_normals_ = all_normals || std::ranges::any_of(placed, [](const Placed& one) {
                           return one.primitive->attributes.contains("NORMAL");
                       });
        has_uv_ = any_uv;
        has_color_ = any_color;
    }

    void add(const Placed& placed) {
        const auto& attributes = placed.primitive->attributes;
        const std::size_t first = surface_.position.size();
        const Accessor position = accessor(attributes.at("POSITION"), 3);
        const std::size_t count = position.count();
        add_vectors(
            position,
            [&](std::array<double, 3> v) {
                v = placed.to_world.point(v);
                return std::array{v[0] - origin_.at[0], v[1] - origin_.at[1], v[2] - origin_.at[2]};
            },
            surface_.position);
        const bool is_mirrored = placed.to_world.determinant() < 0;
        if (has_normals_) {
            if (attributes.contains("NORMAL")) {
                const Accessor normal = accessor(attributes.at("NORMAL"), 3);
                require_as_many(normal, count, "normals");
                const Affine to_world = placed.to_world.cofactors();
                const double sign = is_mirrored ? -1 : 1;
                add_vectors(
                    normal, [&](std::array<double, 3> v) { return unit(to_world.linear(v), sign); },
                    surface_.normal);
            } else {
                for (std::size_t i = 0; i < count; ++i) surface_.normal.push_back({});
            }
        }
        if (has_uv_) add_uv(attributes, count);
        if (has_color_) add_colors(attributes, count);
        add_triangles(placed, first, count, is_mirrored);
    }

    static std::array<double, 3> unit(std::array<double, 3> v, double sign) {
        const double size = std::hypot(v[0], v[1], v[2]);
        const double scale = size > 0 ? sign / size : 0;
        return {scale * v[0], scale * v[1], scale * v[2]};
    }

    template <class Change>
    static void add_vectors(const Accessor& accessor, Change change, Vectors& to) {
        const Array<double> x = accessor.read(0), y = accessor.read(1), z = accessor.read(2);
        for (std::size_t i = 0; i < accessor.count(); ++i) {
            const std::array<double, 3> v = change({x[i], y[i], z[i]});
            to.push_back({static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])});
        }
    }

    /// glTF counts v downwards.
    void add_uv(const std::map<std::string, int>& attributes, std::size_t count) {
        const std::size_t all = surface_.u.size() + count;
        if (attributes.contains("TEXCOORD_0")) {
            const Accessor uv = accessor(attributes.at("TEXCOORD_0"), 2);
            require_as_many(uv, count, "texture coordinates");
            for (const double u : uv.read(0)) surface_.u.push_back(static_cast<float>(u));
            for (const double v : uv.read(1)) surface_.v.push_back(static_cast<float>(1 - v));
        }
        while (surface_.u.size() < all) {
            surface_.u.push_back(0);
            surface_.v.push_back(0);
        }
    }

    void add_colors(const std::map<std::string, int>& attributes, std::size_t count) {
        if (!attributes.contains("COLOR_0")) {
            for (std::size_t i = 0; i < count; ++i) surface_.color.push_back({1, 1, 1});
            return;
        }
        const int index = attributes.at("COLOR_0");
        const bool has_alpha = Accessor::components_of(document_, index) == 4;
        const Accessor color = accessor(index, has_alpha ? 4 : 3);
        require_as_many(color, count, "colours");
        add_vectors(color, [](std::array<double, 3> c) { return c; }, surface_.color);
        if (has_alpha && !has_opacity_)
            has_opacity_ = std::ranges::any_of(color.read(3), [](double alpha) { return alpha != 1; });
    }

    static void require_as_many(const Accessor& accessor, std::size_t count, std::string_view what) {
        if (accessor.count() != count)
            throw BadFile(
                fmt::format("has a primitive of {} positions and {} {}", count, accessor.count(), what));
    }

    void add_triangles(const Placed& placed, std::size_t first, std::size_t count, bool is_mirrored) {
        Array<double> corners;
        if (placed.primitive->indices >= 0) {
            corners = accessor(placed.primitive->indices, 1).read(0);
        } else {
            corners.resize(count);
            for (std::size_t i = 0; i < count; ++i) corners[i] = static_cast<double>(i);
        }
        const auto vertex = [&](std::size_t corner) {
            const double index = corners[corner];
            if (!(index >= 0 && index < static_cast<double>(count)))
                throw BadFile(fmt::format(
                    "has a triangle whose corner is out of range: vertex {:g} of {}, counted from 0", index,
                    count));
            return static_cast<std::uint32_t>(first + static_cast<std::size_t>(index));
        };
        const auto triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
            if (is_mirrored) std::swap(b, c);
            for (const std::size_t corner : {a, b, c}) surface_.indices.push_back(vertex(corner));
        };
        switch (placed.primitive->mode) {
            case TINYGLTF_MODE_TRIANGLE_STRIP:
                for (std::size_t i = 0; i + 2 < corners.size(); ++i)
                    triangle(i, i + 1 + i % 2, i + 2 - i % 2);
                break;
            case TINYGLTF_MODE_TRIANGLE_FAN:
                for (std::size_t i = 1; i + 1 < corners.size(); ++i) triangle(i, i + 1, 0);
                break;
            default:
                if (corners.size() % 3 != 0)
                    throw BadFile(fmt::format("has triangles of {} corners, which is no multiple of three",
                                              corners.size()));
                for (std::size_t i = 0; i < corners.size(); i += 3) triangle(i, i + 1, i + 2);
        }
    }

    Document document_;
    const Origin& origin_;
    Surface surface_;
    std::optional<std::uint32_t> no_material_;  // its number, where a primitive has none
    bool has_normals_ = false;
    bool has_uv_ = false;
    bool has_color_ = false;
    bool has_opacity_ = false;
};

}  // namespace

}  // namespace gltf

Surface read_gltf(std::string_view bytes, const Origin& origin, const std::filesystem::path& folder,
                  Reach reach) {
    return gltf::Reader(gltf::read_document(without_mark(bytes), folder, reach), origin).read();
}

}  // namespace mesh
