// The primitives that a glTF file's scene shows, with their transformations.
#pragma once

#include <vector>

#include "mesh_io/gltf/affine.h"
#include "mesh_io/gltf/document.h"

namespace mesh_io::gltf {

struct Placed {
    const tinygltf::Primitive* primitive;
    Affine to_world;
    int skin = -1;
    const std::vector<double>* weights = nullptr;  // of the primitive's morph targets; null: none
};

/// In the order of nodes and primitives, without hidden nodes; points and lines are left out. Throws
/// BadFile.
std::vector<Placed> placed_primitives(const Document& document);

/// The transformation to world space of each node, whether or not a scene shows it. Throws BadFile if a node
/// contains itself.
std::vector<Affine> node_transformations(const Document& document);

}  // namespace mesh_io::gltf
