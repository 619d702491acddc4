
#ifdef READS_CHANNELS
#if defined(LIT_AT_FRAGMENT) || defined(OPACITY_READS_CHANNELS)
flat in vec4 at_channel_edges;
#endif
#ifdef LIT_AT_FRAGMENT
in vec4 at_channels_0;
in vec4 at_channels_1;
#endif
#ifdef READS_PICTURES
#if defined(LIT_AT_FRAGMENT) || defined(OPACITY_READS_CHANNELS)
vec3 second_material_texel(ColorTexture t, vec3 u, vec3 v) { return texel_at(t, lit_channels_0.xy, at_channel_edges, u, v); }
#else
vec3 second_material_texel(ColorTexture t, vec3 u, vec3 v) { return vec3(0.0); }
#endif
#endif
#endif
