
#if defined(TEXTURED) && defined(LIT_AT_FRAGMENT)
// The change of the line of sight from pixel to pixel: in metres, at a distance of 1 in perspective.
uniform vec3 pixel_right;
uniform vec3 pixel_up;
#ifndef NEEDS_TRIANGLE
flat in vec3 at_p0;
flat in vec3 at_p1;
flat in vec3 at_p2;
#endif
flat in vec4 at_uv_edges;
vec3 texture_seen(vec3 place, vec2 uv) {
    vec3 line = is_orthographic ? -towards_observer : place - eye;
    float depth = is_orthographic ? 1.0 : -dot(towards_observer, line);
    float level = color_texture_level(at_p1 - at_p0, at_p2 - at_p0, at_uv_edges.xy, at_uv_edges.zw, line, depth * pixel_right,
                                      depth * pixel_up, vec2(color_texture.width, color_texture.height));
    return color_texture_at(color_texture, uv, level);
}
#endif
