#include "mesh_io/gltf/walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <ranges>
#include <utility>

#include "mesh_io/gltf/accessor.h"
#include "mesh_io/surface.h"

namespace mesh_io::gltf {

namespace {

template <std::size_t N>
std::array<double, N> numbers_or(const std::vector<double>& given, std::array<double, N> otherwise) {
    if (given.size() == N) std::ranges::copy(given, otherwise.begin());
    return otherwise;
}

Affine transformation_of(const tinygltf::Node& node) {
    if (node.matrix.size() != 16) {
        return affine_of(numbers_or<3>(node.translation, {0, 0, 0}),
                         numbers_or<4>(node.rotation, {0, 0, 0, 1}), numbers_or<3>(node.scale, {1, 1, 1}));
    }
    Affine r;
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t row = 0; row < 3; ++row) r.column[c][row] = node.matrix[4 * c + row];
    return r;
}

std::size_t node_at(const tinygltf::Model& model, int index) {
    if (index < 0 || static_cast<std::size_t>(index) >= model.nodes.size())
        throw BadFile(fmt::format("has no node {}", index));
    return static_cast<std::size_t>(index);
}

std::vector<int> nodes_without_parent(const tinygltf::Model& model) {
    std::vector<bool> is_child(model.nodes.size());
    for (const tinygltf::Node& node : model.nodes)
        for (const int child : node.children) is_child[node_at(model, child)] = true;
    std::vector<int> roots;
    for (std::size_t i = 0; i < is_child.size(); ++i)
        if (!is_child[i]) roots.push_back(static_cast<int>(i));
    return roots;
}

/// Visits the nodes below `roots`, parents first; visits children only if visit(node, transformation) returns
/// true.
template <class Visit>
void walk(const tinygltf::Model& model, const std::vector<int>& roots, Visit visit) {
    std::vector<bool> seen(model.nodes.size());
    std::vector<std::pair<int, Affine>> open;
    for (const int root : std::views::reverse(roots)) open.emplace_back(root, Affine{});
    while (!open.empty()) {
        const auto [index, parent] = open.back();
        open.pop_back();
        const std::size_t at = node_at(model, index);
        if (seen[at])
            throw BadFile(fmt::format("has a node {} that has two parents or contains itself", index));
        seen[at] = true;
        const Affine to_world = parent * transformation_of(model.nodes[at]);
        if (!visit(at, to_world)) continue;
        for (const int child : std::views::reverse(model.nodes[at].children))
            open.emplace_back(child, to_world);
    }
}

class Collector {
  public:
    explicit Collector(const Document& document)
        : document_(document), most_(std::max<std::size_t>(std::size_t{1} << 20, document.bytes)) {}

    void add(std::size_t number, const Affine& to_world) {
        const tinygltf::Node& node = document_.model.nodes[number];
        if (node.mesh < 0) return;
        const auto& meshes = document_.model.meshes;
        if (static_cast<std::size_t>(node.mesh) >= meshes.size())
            throw BadFile(fmt::format("has no mesh {}", node.mesh));
        const tinygltf::Mesh& mesh = meshes[static_cast<std::size_t>(node.mesh)];
        const std::vector<double>& weights = node.weights.empty() ? mesh.weights : node.weights;
        const auto instances = document_.instances.find(number);
        if (instances == document_.instances.end()) return add(mesh, to_world, node.skin, weights);
        for (const Affine& instance : transformations_of(instances->second))
            add(mesh, to_world * instance, node.skin, weights);
    }

    void add(const tinygltf::Mesh& mesh, const Affine& to_world, int skin,
             const std::vector<double>& weights) {
        for (const tinygltf::Primitive& primitive : mesh.primitives) {
            const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
            if (mode < TINYGLTF_MODE_TRIANGLES) continue;  // points and lines
            if (mode > TINYGLTF_MODE_TRIANGLE_FAN)
                throw BadFile(fmt::format("has a primitive of mode {}", mode));
            if (!primitive.attributes.contains("POSITION")) continue;
            if (placed.size() >= most_)
                throw BadFile(fmt::format("repeats its {} bytes more than {} times", document_.bytes, most_));
            placed.push_back({&primitive, to_world, skin, &weights});
        }
    }

    std::vector<Placed> placed;

  private:
    std::vector<Affine> transformations_of(const Instances& instances) const {
        std::size_t count = 0;
        std::vector<Array<double>> values;
        const auto read = [&](int index, int components) {
            if (index < 0) {
                values.resize(values.size() + static_cast<std::size_t>(components));
                return;
            }
            const Accessor accessor(document_, index, components);
            if (count != 0 && accessor.count() != count)
                throw BadFile(
                    fmt::format("has instances whose numbers differ: {} and {}", count, accessor.count()));
            count = accessor.count();
            for (int c = 0; c < components; ++c) values.push_back(accessor.read(c));
        };
        read(instances.translation, 3);
        read(instances.rotation, 4);
        read(instances.scale, 3);
        std::vector<Affine> result(count);
        for (std::size_t i = 0; i < count; ++i) {
            const auto value = [&](std::size_t which, double otherwise) {
                return values[which].empty() ? otherwise : values[which][i];
            };
            result[i] = affine_of({value(0, 0), value(1, 0), value(2, 0)},
                                  {value(3, 0), value(4, 0), value(5, 0), value(6, 1)},
                                  {value(7, 1), value(8, 1), value(9, 1)});
        }
        return result;
    }

    const Document& document_;
    std::size_t most_;
};

}  // namespace

std::vector<Placed> placed_primitives(const Document& document) {
    const tinygltf::Model& model = document.model;
    Collector collector(document);
    const auto visit = [&](std::size_t node, const Affine& to_world) {
        if (node < document.is_hidden.size() && document.is_hidden[node]) return false;
        collector.add(node, to_world);
        return true;
    };
    if (!model.scenes.empty()) {
        const int scene = model.defaultScene < 0 ? 0 : model.defaultScene;
        if (static_cast<std::size_t>(scene) >= model.scenes.size())
            throw BadFile(fmt::format("has no scene {}", scene));
        walk(model, model.scenes[static_cast<std::size_t>(scene)].nodes, visit);
    } else if (!model.nodes.empty()) {
        walk(model, nodes_without_parent(model), visit);
    } else {
        for (const tinygltf::Mesh& mesh : model.meshes) collector.add(mesh, {}, -1, mesh.weights);
    }
    return std::move(collector.placed);
}

std::vector<Affine> node_transformations(const Document& document) {
    const tinygltf::Model& model = document.model;
    std::vector<Affine> result(model.nodes.size());
    std::size_t count = 0;
    walk(model, nodes_without_parent(model), [&](std::size_t node, const Affine& to_world) {
        result[node] = to_world;
        ++count;
        return true;
    });
    if (count != result.size()) throw BadFile("has a node that contains itself");
    return result;
}

}  // namespace mesh_io::gltf
