
#ifdef READS_CHANNELS
layout(location = 13) in vec4 channels_0;
layout(location = 14) in vec4 channels_1;
#if defined(LIT_AT_FRAGMENT) || defined(OPACITY_READS_CHANNELS)
// How two of them change along two edges of the triangle: second texture coordinates, or those that the opacity reads.
layout(location = 12) in vec4 channel_edges;
flat out vec4 at_channel_edges;
#endif
#ifdef LIT_AT_FRAGMENT
out vec4 at_channels_0;
out vec4 at_channels_1;
void pass_channels() {
    at_channels_0 = channels_0;
    at_channels_1 = channels_1;
    at_channel_edges = channel_edges;
}
#endif
#ifdef READS_PICTURES
vec3 second_material_texel(ColorTexture t, vec3 u, vec3 v) {
    vec3 at = vec3(lit_channels_0.xy, 1.0);
    return color_texture_at(t, vec2(dot(u, at), dot(v, at)), 0.0);
}
#endif
#endif
