// Places cameras and lights, which look along -z of their nodes.
#pragma once

#include "candela/target/renderers.h"
#include "document.h"

namespace candela::gltf_target {

/// The matrix of a node, column by column.
inline Json placement(const target::ViewAxes& axes, Vec3 position) {
    Json matrix = Json::array();
    for (const target::Vector& axis : {axes.right, axes.up, axes.backward})
        matrix.insert(matrix.end(), {axis[0], axis[1], axis[2], 0});
    matrix.insert(matrix.end(), {position.x, position.y, position.z, 1});
    return matrix;
}

}  // namespace candela::gltf_target
