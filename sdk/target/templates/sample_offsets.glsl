
// Where within its extent, from -1/2 to 1/2 along both edges, sample k of a light is seen from the pixel: a regular pattern
// (Roberts 2018, "The unreasonable effectiveness of quasirandom sequences").
vec2 sample_offsets(int k) {
    uint x = 3679390609u * seen_pixel.x + 3152041523u * seen_pixel.y + 3242174889u * uint(k);
    uint y = 2700274806u * seen_pixel.x + 2313257605u * seen_pixel.y + 2447445414u * uint(k);
    return vec2(ivec2(x, y) >> 8) / 16777216.0;
}
