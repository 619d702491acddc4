// Pictures that give numbers of surfaces.
@FILE@
struct ColorTexture {
    const std::vector<TextureLevel>* levels = nullptr;  // null: no texture
    int wrap_u = 0, wrap_v = 0;
};

int color_texture_levels(ColorTexture t) { return static_cast<int>(t.levels->size()); }
const TextureLevel& level_of(ColorTexture t, int level) { return (*t.levels)[static_cast<std::size_t>(level)]; }
int color_texture_width(ColorTexture t, int level) { return level_of(t, level).width; }
int color_texture_height(ColorTexture t, int level) { return level_of(t, level).height; }

vec3 color_texture_texel(ColorTexture t, int level, int x, int y) {
    const TextureLevel& of = level_of(t, level);
    const std::uint16_t* const texel = &of.texels[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(of.width) + static_cast<std::size_t>(x))];
    return vec3(texel[0], texel[1], texel[2]) / 65535.0f;
}

@KERNEL@
@PICTURES@
