// Light at surface points: textures, environment, normals, lights, reflection.
export module candela.shading;

export import :environment_map;
export import :radiance_map;
export import :surface;
export import :surface_shader;
export import :term;
export import :texture;
export import :trace;
