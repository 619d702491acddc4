// A texture's texels, 65535 for an intensity of 1: the picture, and its mip levels in a row along its longer side. They are
// integers, which no driver filters: the functions below interpolate, so that every driver draws the same picture.
struct ColorTexture {
    int width;
    int height;
    int levels;
    int wrap_u;
    int wrap_v;
    int unit;  // whose texels it has
};
@UNITS@@SHADOW_PICTURES@int color_texture_levels(ColorTexture t) { return t.levels; }
int color_texture_width(ColorTexture t, int level) { return max(t.width >> level, 1); }
int color_texture_height(ColorTexture t, int level) { return max(t.height >> level, 1); }
vec3 color_texture_texel(ColorTexture t, int level, int x, int y) {
@SHADOW_PICTURE@
    int longer = max(t.width, t.height);
    int along = longer - (longer >> max(level - 1, 0));
    ivec2 corner = t.width >= t.height ? ivec2(along, t.height) : ivec2(t.width, along);
    return vec3(texel_of_unit(t.unit, (level == 0 ? ivec2(0) : corner) + ivec2(x, y)).rgb) / 65535.0;
}

