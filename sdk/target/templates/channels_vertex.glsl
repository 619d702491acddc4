
#ifdef READS_CHANNELS
layout(location = 13) in vec4 channels_0;
layout(location = 14) in vec4 channels_1;
#ifdef LIT_AT_FRAGMENT
layout(location = 12) in vec4 second_uv_edges;
out vec4 at_channels_0;
out vec4 at_channels_1;
flat out vec4 at_second_uv_edges;
void pass_channels() {
    at_channels_0 = channels_0;
    at_channels_1 = channels_1;
    at_second_uv_edges = second_uv_edges;
}
#endif
#ifdef READS_PICTURES
vec3 second_material_texel(ColorTexture t, vec3 u, vec3 v) {
    vec3 at = vec3(lit_channels_0.xy, 1.0);
    return color_texture_at(t, vec2(dot(u, at), dot(v, at)), 0.0);
}
#endif
#endif
