// The whole core, for programs that use it as a library. Plugins include the header of their kind instead.
export module candela.core;

export import candela.api;
export import candela.util;
export import candela.plugins;
export import candela.scene;
export import candela.geometry;
export import candela.raster;
export import candela.shading;
export import candela.render;
