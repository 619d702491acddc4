#include "mesh_io/gltf/pose.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "mesh_io/surface.h"

namespace mesh_io::gltf {

namespace {

/// The transformation of each joint of a skin from where the mesh was bound to it to where it is now.
std::vector<Affine> joint_matrices(const Document& document, int index, const std::vector<Affine>& nodes) {
    if (static_cast<std::size_t>(index) >= document.skins.size())
        throw BadFile(fmt::format("has no skin {}", index));
    const Skin& skin = document.skins[static_cast<std::size_t>(index)];
    std::vector<Affine> result;
    for (const int joint : skin.joints) {
        if (joint < 0 || static_cast<std::size_t>(joint) >= nodes.size())
            throw BadFile(fmt::format("has no node {}", joint));
        result.push_back(nodes[static_cast<std::size_t>(joint)]);
    }
    if (skin.inverse_matrices < 0) return result;
    const Accessor inverse(document, skin.inverse_matrices, 16);
    if (inverse.count() < result.size())
        throw BadFile(
            fmt::format("has a skin {} of {} joints and {} matrices", index, result.size(), inverse.count()));
    std::vector<Affine> matrices(result.size());
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t row = 0; row < 3; ++row) {
            const Array<double> values = inverse.read(static_cast<int>(4 * c + row));
            for (std::size_t i = 0; i < matrices.size(); ++i) matrices[i].column[c][row] = values[i];
        }
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = result[i] * matrices[i];
    return result;
}

}  // namespace

Pose::Pose(const Document& document, const Placed& placed, std::size_t count,
           const std::vector<Affine>& nodes)
    : document_(document), placed_(placed), count_(count) {
    if (placed.skin < 0) return;
    const auto& attributes = placed.primitive->attributes;
    for (const char* const set : {"0", "1"}) {
        const auto joints = attributes.find(std::string("JOINTS_") + set);
        const auto weights = attributes.find(std::string("WEIGHTS_") + set);
        if (joints == attributes.end() || weights == attributes.end()) continue;
        const Accessor joint(document, joints->second, 4), weight(document, weights->second, 4);
        if (joint.count() != count || weight.count() != count)
            throw BadFile(fmt::format("has a primitive of {} positions and {} joints", count, joint.count()));
        for (int c = 0; c < 4; ++c) {
            joints_.push_back(joint.read(c));
            weights_.push_back(weight.read(c));
        }
    }
    if (joints_.empty()) return;
    matrices_ = joint_matrices(document, placed.skin, nodes);
    for (std::size_t k = 0; k < joints_.size(); ++k)
        for (std::size_t i = 0; i < count; ++i) {
            double& weight = weights_[k][i];
            if (!(std::abs(weight) <= 1e6)) weight = 0;  // and NaN
            if (weight != 0 && !(joints_[k][i] >= 0 && joints_[k][i] < static_cast<double>(matrices_.size())))
                throw BadFile(
                    fmt::format("has a vertex {} of joint {:g} of {}", i, joints_[k][i], matrices_.size()));
        }
}

void Pose::morph(const char* attribute, std::array<Array<double>, 3>& values) const {
    if (placed_.weights == nullptr) return;
    const auto& targets = placed_.primitive->targets;
    for (std::size_t t = 0; t < std::min(targets.size(), placed_.weights->size()); ++t) {
        const double weight = (*placed_.weights)[t];
        const auto found = targets[t].find(attribute);
        if (weight == 0 || found == targets[t].end()) continue;
        const Accessor target(document_, found->second, 3);
        if (target.count() != count_)
            throw BadFile(fmt::format("has a primitive of {} positions and a morph target of {}", count_,
                                      target.count()));
        for (std::size_t c = 0; c < 3; ++c) {
            const Array<double> moves = target.read(static_cast<int>(c));
            for (std::size_t i = 0; i < count_; ++i) values[c][i] += weight * moves[i];
        }
    }
}

Affine Pose::of(std::size_t vertex) const {
    if (is_rigid()) return placed_.to_world;
    Affine sum;
    for (auto& column : sum.column) column = {};
    double all = 0;
    for (std::size_t k = 0; k < joints_.size(); ++k) {
        const double weight = weights_[k][vertex];
        if (weight == 0) continue;
        all += weight;
        const Affine& matrix = matrices_[static_cast<std::size_t>(joints_[k][vertex])];
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t row = 0; row < 3; ++row) sum.column[c][row] += weight * matrix.column[c][row];
    }
    if (std::abs(all) < 1e-9) {  // without weights it follows its first joint
        const double first = joints_[0][vertex];
        if (matrices_.empty()) return {};
        return first >= 0 && first < static_cast<double>(matrices_.size())
                   ? matrices_[static_cast<std::size_t>(first)]
                   : matrices_[0];
    }
    // Weights are often rounded.
    for (auto& column : sum.column)
        for (double& value : column) value /= all;
    return sum;
}

}  // namespace mesh_io::gltf
