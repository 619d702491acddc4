#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "mesh_io/gltf/accessor.h"
#include "mesh_io/gltf/affine.h"
#include "mesh_io/gltf/document.h"
#include "mesh_io/gltf/pose.h"
#include "mesh_io/gltf/walk.h"
#include "mesh_io/readers.h"

namespace mesh_io {

namespace gltf {

namespace {

class Reader {
  public:
    Reader(Document document, const Origin& origin, Attributes attributes)
        : document_(std::move(document)), origin_(origin), attributes_(attributes) {}

    Surface read() {
        const std::vector<Placed> all = placed_primitives(document_);
        check_counts(all);
        if (std::ranges::any_of(all, [](const Placed& one) { return one.skin >= 0; }))
            nodes_ = node_transformations(document_);
        surface_.materials = std::move(document_.materials);
        for (const Placed& placed : all) {
            add(placed);
            surface_.material.resize(surface_.triangles(), material_of(*placed.primitive));
        }
        if (surface_.triangles() == 0) require_no_points_or_lines();
        surface_.losses = std::move(document_.losses);
        surface_.files = std::move(document_.files);
        surface_.is_color_linear = true;
        if (has_opacity_ && attributes_ == Attributes::skipped)
            surface_.losses.emplace_back("the opacity of vertices");
        const auto note = [&](std::size_t count, const char* what, const char* then,
                              const char* problem = "not finite") {
            if (count > 0)
                surface_.notes.push_back(fmt::format(
                    "has {} {} that {} {}, which {} {}", count, count == 1 ? what : std::string(what) + 's',
                    count == 1 ? "is" : "are", problem, count == 1 ? "is" : "are", then));
        };
        note(bad_normals_, "normal", "computed from the triangles instead");
        note(bad_tangents_, "tangent", "computed from the triangles instead", "unusable");
        note(bad_uv_, "texture coordinate", "0 instead");
        note(bad_numbers_, "number of a vertex attribute", "0 instead");
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

    /// Throws if the file has nothing else.
    void require_no_points_or_lines() const {
        std::size_t points = 0, lines = 0;
        for (const tinygltf::Mesh& mesh : document_.model.meshes)
            for (const tinygltf::Primitive& primitive : mesh.primitives) {
                if (primitive.mode == TINYGLTF_MODE_POINTS) ++points;
                if (primitive.mode > TINYGLTF_MODE_POINTS && primitive.mode < TINYGLTF_MODE_TRIANGLES)
                    ++lines;
            }
        std::string sets;
        for (const auto& [count, of] : {std::pair(points, "points"), std::pair(lines, "lines")})
            if (count > 0)
                sets += fmt::format("{}{} set{} of {}", sets.empty() ? "" : " and ", count,
                                    count == 1 ? "" : "s", of);
        if (!sets.empty())
            throw BadFile(fmt::format("has {} and no triangles; Candela draws surfaces", sets));
    }

    /// Nodes and primitives may share accessors: a small file can describe any number of triangles.
    void check_counts(const std::vector<Placed>& placed) {
        std::uint64_t numbers = 0;
        bool all_normals = true, any_uv = false, any_color = false;
        for (const Placed& one : placed) {
            const auto& attributes = one.primitive->attributes;
            numbers += accessor(attributes.at("POSITION"), 3).count();
            if (one.weights != nullptr)
                numbers += accessor(attributes.at("POSITION"), 3).count() * one.primitive->targets.size();
            if (one.primitive->indices >= 0) numbers += accessor(one.primitive->indices, 1).count();
            all_normals = all_normals && attributes.contains("NORMAL");
            any_uv = any_uv || attributes.contains("TEXCOORD_0");
            any_color = any_color || attributes.contains("COLOR_0");
            constexpr std::uint64_t k_most_repeated = std::uint64_t{1} << 25;
            if (numbers > std::max<std::uint64_t>(k_most_repeated, document_.bytes)) {
                throw BadFile(fmt::format("repeats its {} bytes to more than {} vertices and corners",
                                          document_.bytes, k_most_repeated));
            }
        }
        has_normals_ = all_normals || std::ranges::any_of(placed, [](const Placed& one) {
                           return one.primitive->attributes.contains("NORMAL");
                       });
        has_tangents_ = any_uv && std::ranges::any_of(placed, [](const Placed& one) {
                            return has_tangents(one.primitive->attributes);
                        });
        has_uv_ = any_uv;
        has_color_ = any_color;
        if (attributes_ == Attributes::read)
            for (const Placed& one : placed) name_attributes(one.primitive->attributes);
    }

    /// A name that a scene knows, and how many numbers it has: 0 for what is read elsewhere.
    std::pair<std::string, std::size_t> attribute_of(const std::string& name, int index) const {
        const auto count = static_cast<std::size_t>(Accessor::components_of(document_, index));
        if (name == k_second_uv) return {"uv1", 2};
        if (name == "COLOR_0") return {"color", count == 4 ? 4 : 3};
        return {name, name.starts_with('_') && count <= 4 ? count : 0};
    }

    void name_attributes(const std::map<std::string, int>& attributes) {
        for (const auto& [name, index] : attributes) {
            const auto [known_as, count] = attribute_of(name, index);
            if (count == 0) continue;
            const auto same = std::ranges::find(surface_.attributes, known_as, &Attribute::name);
            Attribute& to =
                same != surface_.attributes.end() ? *same : surface_.attributes.emplace_back(known_as);
            to.channels.resize(std::max(to.channels.size(), count));
        }
    }

    /// Primitives without an attribute have zeros, and ones as their colours.
    void add_attributes(const std::map<std::string, int>& attributes, std::size_t count) {
        const std::size_t all = surface_.position.size();
        for (const auto& [name, index] : attributes) {
            const auto [known_as, numbers] = attribute_of(name, index);
            if (numbers == 0) continue;
            Attribute& to = *std::ranges::find(surface_.attributes, known_as, &Attribute::name);
            const Accessor values = accessor(index, static_cast<int>(numbers));
            require_as_many(values, count, fmt::format("values of '{}'", name));
            for (std::size_t c = 0; c < numbers; ++c)
                for (const double value : values.read(static_cast<int>(c)))
                    to.channels[c].push_back(
                        finite(known_as == "uv1" && c == 1 ? 1 - value : value, bad_numbers_));
        }
        for (Attribute& attribute : surface_.attributes)
            for (Array<float>& channel : attribute.channels)
                channel.resize(all, attribute.name == "color" ? 1.0f : 0.0f);
    }

    static float finite(double value, std::size_t& bad) {
        const auto single = static_cast<float>(value);
        if (std::isfinite(single)) return single;
        ++bad;
        return 0.0f;
    }

    void add(const Placed& placed) {
        const auto& attributes = placed.primitive->attributes;
        const std::size_t first = surface_.position.size();
        const int accessor_of_positions = attributes.at("POSITION");
        const Accessor position = accessor(accessor_of_positions, 3);
        const std::size_t count = position.count();
        const Pose pose(document_, placed, count, nodes_);
        const bool is_mirrored = (count > 0 ? pose.of(0) : placed.to_world).determinant() < 0;
        std::array<Array<double>, 3> values = read(position);
        pose.morph("POSITION", values);
        // With many primitives, each would move everything read so far.
        if (first == 0)
            for (Vectors* const each : {&surface_.position, &surface_.normal})
                for (Array<float>* const axis : {&each->x, &each->y, &each->z})
                    if (each == &surface_.position || has_normals_) axis->reserve(count);
        for (std::size_t i = 0; i < count; ++i) {
            const std::array<double, 3> v = {values[0][i], values[1][i], values[2][i]};
            const std::array<double, 3> p = pose.is_rigid() ? placed.to_world.point(v) : pose.of(i).point(v);
            if (!is_finite(p))
                throw BadFile(
                    fmt::format("has a vertex that is not finite: number {} of accessor {}, ({}, {}, {})", i,
                                accessor_of_positions, v[0], v[1], v[2]));
            const auto& origin = origin_.at;
            push_back(surface_.position, {p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]});
        }
        if (has_normals_) add_normals(attributes, placed, pose, count, is_mirrored);
        if (has_tangents_) add_tangents(attributes, pose, count, is_mirrored);
        if (has_uv_) add_uv(attributes, count);
        if (has_color_) add_colors(attributes, count);
        if (attributes_ == Attributes::read) add_attributes(attributes, count);
        add_triangles(placed, first, count, is_mirrored);
    }

    void add_normals(const std::map<std::string, int>& attributes, const Placed& placed, const Pose& pose,
                     std::size_t count, bool is_mirrored) {
        if (!attributes.contains("NORMAL")) {
            for (std::size_t i = 0; i < count; ++i) surface_.normal.push_back({});
            return;
        }
        const Accessor normal = accessor(attributes.at("NORMAL"), 3);
        require_as_many(normal, count, "normals");
        std::array<Array<double>, 3> values = read(normal);
        pose.morph("NORMAL", values);
        const Affine to_world = placed.to_world.cofactors();
        const double sign = is_mirrored ? -1 : 1;
        for (std::size_t i = 0; i < count; ++i) {
            const std::array<double, 3> v = {values[0][i], values[1][i], values[2][i]};
            const Affine turn = pose.is_rigid() ? to_world : pose.of(i).cofactors();
            std::array<double, 3> n = unit(turn.linear(v), sign);
            if (!is_finite(v) || !is_finite(n)) {
                n = {};
                ++bad_normals_;
            }
            push_back(surface_.normal, n);
        }
    }

    /// glTF's tangents refer to its normals, and are without meaning if these are missing.
    static bool has_tangents(const std::map<std::string, int>& attributes) {
        return attributes.contains("TANGENT") && attributes.contains("NORMAL");
    }

    void add_tangents(const std::map<std::string, int>& attributes, const Pose& pose, std::size_t count,
                      bool is_mirrored) {
        const std::size_t first = surface_.tangent.size();
        for (std::size_t i = 0; i < count; ++i) {
            surface_.tangent.push_back({});
            surface_.tangent_side.push_back(1);
        }
        if (!has_tangents(attributes)) return;
        std::optional<Accessor> tangent;
        std::array<Array<double>, 3> values;
        try {
            tangent.emplace(accessor(attributes.at("TANGENT"), 4));
            require_as_many(*tangent, count, "tangents");
            values = read(*tangent);
            pose.morph("TANGENT", values);
        } catch (const BadFile&) {
            // They can be computed, as they are for files without.
            bad_tangents_ += count;
            return;
        }
        const Array<double> side = tangent->read(3);
        for (std::size_t i = 0; i < count; ++i) {
            const std::array<double, 3> v = {values[0][i], values[1][i], values[2][i]};
            const std::array<double, 3> t = unit(pose.of(i).linear(v), 1);
            if (!is_finite(v) || !is_finite(t) || !std::isfinite(side[i])) {
                ++bad_tangents_;
                continue;
            }
            surface_.tangent.span().set(
                first + i, {static_cast<float>(t[0]), static_cast<float>(t[1]), static_cast<float>(t[2])});
            // The world's cross product of normal and tangent is the mirror image of theirs in a mirror.
            surface_.tangent_side[first + i] = (side[i] < 0) == is_mirrored ? 1.0f : -1.0f;
        }
    }

    static std::array<double, 3> unit(std::array<double, 3> v, double sign) {
        const double size = std::hypot(v[0], v[1], v[2]);
        const double scale = size > 0 ? sign / size : 0;
        return {scale * v[0], scale * v[1], scale * v[2]};
    }

    static bool is_finite(const std::array<double, 3>& v) {
        return std::ranges::all_of(v, [](double x) { return std::isfinite(static_cast<float>(x)); });
    }

    static std::array<Array<double>, 3> read(const Accessor& accessor) {
        return {accessor.read(0), accessor.read(1), accessor.read(2)};
    }

    static void push_back(Vectors& to, const std::array<double, 3>& v) {
        to.push_back({static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])});
    }

    /// glTF counts v downwards.
    void add_uv(const std::map<std::string, int>& attributes, std::size_t count) {
        const std::size_t all = surface_.u.size() + count;
        if (attributes.contains("TEXCOORD_0")) {
            const Accessor uv = accessor(attributes.at("TEXCOORD_0"), 2);
            require_as_many(uv, count, "texture coordinates");
            for (const double u : uv.read(0)) surface_.u.push_back(finite(u, bad_uv_));
            for (const double v : uv.read(1)) surface_.v.push_back(finite(1 - v, bad_uv_));
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
        const std::array<Array<double>, 3> values = read(color);
        for (std::size_t i = 0; i < count; ++i)
            push_back(surface_.color, {values[0][i], values[1][i], values[2][i]});
        if (has_alpha && !has_opacity_)
            has_opacity_ = std::ranges::any_of(color.read(3), [](double alpha) { return alpha != 1; });
    }

    static void require_as_many(const Accessor& accessor, std::size_t count, std::string_view what) {
        if (accessor.count() != count)
            throw BadFile(
                fmt::format("has a primitive of {} positions and {} {}", count, accessor.count(), what));
    }

    /// Reads triangles stored as in most files. Returns false and adds nothing for any other layout or an
    /// invalid one.
    bool add_whole_triangles(const Placed& placed, std::size_t first, std::size_t count, bool is_mirrored) {
        const int mode = placed.primitive->mode;
        if (placed.primitive->indices < 0 || (mode >= 0 && mode != TINYGLTF_MODE_TRIANGLES)) return false;
        auto corners = accessor(placed.primitive->indices, 1).whole_numbers();
        if (!corners || corners->size() % 3 != 0) return false;
        std::uint32_t highest = 0;
        for (const std::uint32_t corner : *corners) highest = std::max(highest, corner);
        if (!corners->empty() && highest >= count) return false;
        if (is_mirrored)
            for (std::size_t i = 0; i < corners->size(); i += 3)
                std::swap((*corners)[i + 1], (*corners)[i + 2]);
        if (first > 0)
            for (std::uint32_t& corner : *corners) corner += static_cast<std::uint32_t>(first);
        if (surface_.indices.empty()) {
            surface_.indices = *std::move(corners);
        } else {
            surface_.indices.insert(surface_.indices.end(), corners->begin(), corners->end());
        }
        return true;
    }

    void add_triangles(const Placed& placed, std::size_t first, std::size_t count, bool is_mirrored) {
        if (add_whole_triangles(placed, first, count, is_mirrored)) return;
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
                    throw BadFile(fmt::format("has triangles of {} corners, which is not a multiple of three",
                                              corners.size()));
                for (std::size_t i = 0; i < corners.size(); i += 3) triangle(i, i + 1, i + 2);
        }
    }

    Document document_;
    const Origin& origin_;
    Attributes attributes_;
    Surface surface_;
    std::vector<Affine> nodes_;                 // where there are skins
    std::optional<std::uint32_t> no_material_;  // its number, for primitives without a material
    bool has_normals_ = false;
    bool has_tangents_ = false;
    bool has_uv_ = false;
    bool has_color_ = false;
    bool has_opacity_ = false;
    std::size_t bad_normals_ = 0, bad_tangents_ = 0, bad_uv_ = 0, bad_numbers_ = 0;
};

}  // namespace

}  // namespace gltf

Surface read_gltf(std::string_view bytes, const Origin& origin, const std::filesystem::path& folder,
                  FileScope reach, Attributes attributes) {
    return gltf::Reader(gltf::read_document(without_mark(bytes), folder, reach, attributes), origin,
                        attributes)
        .read();
}

}  // namespace mesh_io
