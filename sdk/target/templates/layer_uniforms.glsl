
// Depth peeling: of each pixel, the surface behind those of the layers before.
uniform highp sampler2D covered;      // what they show; the fourth number is the part of the pixel that they cover
uniform highp sampler2D depth_before; // of the layer before
uniform bool is_first_layer;
uniform float object_opacity;
uniform float object_opacity_cutoff;  // above 0: the surface is opaque from this opacity on, and absent elsewhere
