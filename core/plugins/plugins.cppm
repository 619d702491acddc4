// Plugins: their manifests, libraries and parameters, found by kind and name.
export module candela.plugins;

export import :formats;
export import :library;
export import :manifest;
export import :parameters;
export import :registry;
