// The stages in order: Scene -> meshes -> normals -> visibility -> fragments -> light -> reflection -> Film.
export module candela.render;

export import :render_scene;
export import :film;
export import :frames;
export import :pixel_inspector;
export import :renderer;
