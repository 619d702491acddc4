// Meshes in world space, and what can be asked of them: containment, rays.
export module candela.geometry;

export import :constraints;
export import :containment;
export import :mesh;
export import :occlusion_tree;
export import :triangle_tree;
