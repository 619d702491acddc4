// The stages in order: Scene -> meshes -> normals -> visibility -> fragments -> light -> reflection -> Film.
export module candela.render;

export import :compiled_scene;
export import :probe;
export import :renderer;
