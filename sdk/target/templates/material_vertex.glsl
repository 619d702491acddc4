#ifdef READS_PICTURES
vec2 lit_uv;
vec3 material_texel(ColorTexture t, vec3 u, vec3 v) {
    vec3 at = vec3(lit_uv, 1.0);
    return color_texture_at(t, vec2(dot(u, at), dot(v, at)), 0.0);
}
#endif
