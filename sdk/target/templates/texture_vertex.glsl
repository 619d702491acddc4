
#if defined(TEXTURED) && (defined(LIT_AT_FRAGMENT) || defined(TEXTURED_OPACITY))
#define TEXTURED_AT_FRAGMENT
#ifndef NEEDS_TRIANGLE
layout(location = 9) in vec3 p0;
layout(location = 10) in vec3 p1;
layout(location = 11) in vec3 p2;
#endif
#if !defined(NEEDS_TRIANGLE) || !defined(LIT_AT_FRAGMENT)
flat out vec3 at_p0;
flat out vec3 at_p1;
flat out vec3 at_p2;
#endif
layout(location = 15) in vec4 uv_edges;
flat out vec4 at_uv_edges;
void pass_texture() {
    at_p0 = p0;
    at_p1 = p1;
    at_p2 = p2;
    at_uv_edges = uv_edges;
}
#endif
#ifdef READS_PICTURES
vec2 lit_uv;
vec3 material_texel(ColorTexture t, vec3 u, vec3 v) {
    vec3 at = vec3(lit_uv, 1.0);
    return color_texture_at(t, vec2(dot(u, at), dot(v, at)), 0.0);
}
#endif
