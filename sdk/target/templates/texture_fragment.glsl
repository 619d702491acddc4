
#if defined(TEXTURED) && (defined(LIT_AT_FRAGMENT) || defined(TEXTURED_OPACITY))
#define TEXTURED_AT_FRAGMENT
// The change of the line of sight from pixel to pixel: in metres, at a distance of 1 in perspective.
uniform vec3 pixel_right;
uniform vec3 pixel_up;
#if !defined(NEEDS_TRIANGLE) || !defined(LIT_AT_FRAGMENT)
flat in vec3 at_p0;
flat in vec3 at_p1;
flat in vec3 at_p2;
#endif
flat in vec4 at_uv_edges;
#endif
#ifdef READS_PICTURES
#ifdef TEXTURED_AT_FRAGMENT
vec3 lit_place;
vec2 lit_uv;
// `edges`: how the coordinates change along two edges of the triangle.
vec3 texel_at(ColorTexture t, vec2 uv, vec4 edges, vec3 u, vec3 v) {
    vec3 line = is_orthographic ? -towards_observer : lit_place - eye;
    float depth = is_orthographic ? 1.0 : -dot(towards_observer, line);
    vec2 along1 = vec2(dot(u.xy, edges.xy), dot(v.xy, edges.xy));
    vec2 along2 = vec2(dot(u.xy, edges.zw), dot(v.xy, edges.zw));
    float level = color_texture_level(at_p1 - at_p0, at_p2 - at_p0, along1, along2, line, depth * pixel_right, depth * pixel_up,
                                      vec2(t.width, t.height));
    vec3 at = vec3(uv, 1.0);
    return color_texture_at(t, vec2(dot(u, at), dot(v, at)), level);
}
vec3 material_texel(ColorTexture t, vec3 u, vec3 v) { return texel_at(t, lit_uv, at_uv_edges, u, v); }
#else
// Light is evaluated at vertices.
vec3 material_texel(ColorTexture t, vec3 u, vec3 v) { return vec3(0.0); }
#endif
#endif
