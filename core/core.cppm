// All of Candela's core, for programs that use it as a library. Plugins import the interface of their kind
// instead.
export module candela.core;

export import candela.arrays;
export import candela.constraints;
export import candela.diagnostics;
export import candela.environment;
export import candela.files;
export import candela.film;
export import candela.fragments;
export import candela.geometry;
export import candela.image;
export import candela.light;
export import candela.lighting;
export import candela.math;
export import candela.memory;
export import candela.mesh;
export import candela.params;
export import candela.plugins;
export import candela.raster;
export import candela.reflection;
export import candela.render;
export import candela.scene;
export import candela.schema;
export import candela.shading;
export import candela.shape;
export import candela.simd;
