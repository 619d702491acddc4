
#if defined(TEXTURED_OPACITY) && !defined(LIT_AT_FRAGMENT)
#define OPACITY_AT_FRAGMENT
@CHANNELS_OUT@
#ifdef READS_PICTURES
out vec3 seen_place;
out vec2 seen_uv;
#endif
// A face's numbers are the mean of its corners'.
vec2 numbers_of_corner(vec2 numbers, vec4 edges) {
#ifdef LIT_AT_FACE
    int corner = gl_VertexID % 3;
    numbers -= (edges.xy + edges.zw) / 3.0;
    if (corner > 0) numbers += corner == 1 ? edges.xy : edges.zw;
#endif
    return numbers;
}
void pass_opacity(vec3 place_of_vertex, vec2 uv_of_vertex) {
#ifdef READS_PICTURES
    pass_texture();
    seen_place = place_of_vertex;
    seen_uv = numbers_of_corner(uv_of_vertex, uv_edges);
#endif
@PASS_CHANNELS@
}
#endif
