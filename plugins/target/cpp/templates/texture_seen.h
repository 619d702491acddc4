// The colour of an object's texture at a place in a triangle. A pixel covers an area of the picture; a face's centre and a
// vertex are points in it.
vec3 texture_within(const Object& o, int triangle, vec3 b) {
    if (o.texture.levels == nullptr) return vec3(1.0f);
    const Mesh& m = o.mesh;
    float level = 0;
    if (rate_of(o) == Rate::pixel) {
        const int* const v = &m.corners[3 * static_cast<std::size_t>(triangle)];
        const auto p = [&](int k) { return m.position[static_cast<std::size_t>(v[k])]; };
        const auto uv = [&](int k) { return m.uv[static_cast<std::size_t>(v[k])]; };
        const vec3 line = k_is_perspective ? blend(m.position, m, triangle, b) - k_eye : k_forward;
        const float pixel = (k_is_perspective ? dot(k_forward, line) : 1.0f) / static_cast<float>(k_pixels_per_unit);
        const vec2 size(static_cast<float>(color_texture_width(o.texture, 0)), static_cast<float>(color_texture_height(o.texture, 0)));
        level = color_texture_level(p(1) - p(0), p(2) - p(0), uv(1) - uv(0), uv(2) - uv(0), line, pixel * k_right, pixel * k_top, size);
    }
    return color_texture_at(o.texture, blend(m.uv, m, triangle, b), level);
}

vec3 texture_at_vertex(const Object& o, std::size_t v) {
    return o.texture.levels == nullptr ? vec3(1.0f) : color_texture_at(o.texture, o.mesh.uv[v], 0.0f);
}

