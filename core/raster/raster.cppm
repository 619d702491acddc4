// Visibility: which triangle each sample of the picture sees.
//
// Triangles are projected once per frame, sorted into tiles of the picture, and rasterised tile by tile. The
// results depend on neither the number of threads nor the size of the tiles.
export module candela.raster;

export import :camera;
export import :fragments;
export import :points;
export import :projected_scene;
export import :visibility;
