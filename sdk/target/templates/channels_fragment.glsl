
#ifdef READS_CHANNELS
#ifdef LIT_AT_FRAGMENT
in vec4 at_channels_0;
in vec4 at_channels_1;
flat in vec4 at_second_uv_edges;
#endif
#ifdef READS_PICTURES
#ifdef LIT_AT_FRAGMENT
vec3 second_material_texel(ColorTexture t, vec3 u, vec3 v) { return texel_at(t, lit_channels_0.xy, at_second_uv_edges, u, v); }
#else
vec3 second_material_texel(ColorTexture t, vec3 u, vec3 v) { return vec3(0.0); }
#endif
#endif
#endif
