// Lights from everywhere, as seen in all directions: levels of octahedral maps, one after the other, in rows of this texture.
uniform highp sampler2D radiance_texels;
struct RadianceMap {
    int first;
    int size;
    float density;
};
RadianceMap radiance_map(vec3 texel) { return RadianceMap(int(texel.x), int(texel.y), texel.z); }
int radiance_size(RadianceMap m, int level) { return m.size >> level; }
int radiance_last_level(RadianceMap m) { return int(log2(float(m.size)) + 0.5); }
vec3 radiance_texel(RadianceMap m, int level, int x, int y) {
    int size = m.size >> level;
    int at = m.first + (m.size * m.size - size * size) / 3 * 4 + y * size + x;
    return texelFetch(radiance_texels, ivec2(at % @WIDTH@, at / @WIDTH@), 0).xyz;
}
