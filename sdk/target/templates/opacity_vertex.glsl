
#if defined(TEXTURED_OPACITY) && !defined(LIT_AT_FRAGMENT)
#define OPACITY_AT_FRAGMENT
out vec3 seen_place;
out vec2 seen_uv;
void pass_opacity(vec3 place_of_vertex, vec2 uv_of_vertex) {
    pass_texture();
    seen_place = place_of_vertex;
    seen_uv = uv_of_vertex;
#ifdef LIT_AT_FACE
    // It is the mean of the face's vertices.
    int corner = gl_VertexID % 3;
    seen_uv -= (uv_edges.xy + uv_edges.zw) / 3.0;
    if (corner > 0) seen_uv += corner == 1 ? uv_edges.xy : uv_edges.zw;
#endif
}
#endif
