// A place where textures are looked up: a pixel, which covers an area of the picture, or a point: a face's centre, a vertex.
struct TexturePlace {
    vec2 uv;
    bool is_pixel = false;
    vec3 edge1, edge2;  // of its triangle, from one corner,
    vec2 uv1, uv2;      // and how the texture coordinates change along them
    vec3 line;          // of sight
    float pixel = 0;    // its size, metres
@ON_MESH_MEMBERS@
};

TexturePlace place_within(const Object& o, int triangle, vec3 b@IS_SEEN_PARAMETER@) {
    const Mesh& m = o.mesh;
    TexturePlace at;
    at.uv = blend(m.uv, m, triangle, b);
@ON_MESH_WITHIN@
    at.is_pixel = @IS_SEEN@rate_of(o) == Rate::pixel;
    if (!at.is_pixel) return at;
    const int* const v = &m.corners[3 * static_cast<std::size_t>(triangle)];
    const auto p = [&](int k) { return m.position[static_cast<std::size_t>(v[k])]; };
    const auto uv = [&](int k) { return m.uv.empty() ? vec2() : m.uv[static_cast<std::size_t>(v[k])]; };
    at.edge1 = p(1) - p(0);
    at.edge2 = p(2) - p(0);
    at.uv1 = uv(1) - uv(0);
    at.uv2 = uv(2) - uv(0);
    at.line = k_is_perspective ? blend(m.position, m, triangle, b) - k_eye : k_forward;
    at.pixel = (k_is_perspective ? dot(k_forward, at.line) : 1.0f) / static_cast<float>(k_pixels_per_unit);
    return at;
}

TexturePlace place_at_vertex(const Object& o, std::size_t v) {
    TexturePlace at;
    if (!o.mesh.uv.empty()) at.uv = o.mesh.uv[v];
@ON_MESH_AT_VERTEX@
    return at;
}

@CHANNELS@
@TEXTURE_AT@
