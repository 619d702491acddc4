// How a texture is placed: u' = m[0] u + m[1] v + m[2], v' with the other three.
using Placing = std::array<float, 6>;

TexturePlace placed(const Placing& m, TexturePlace at) {
    const auto moved = [&](vec2 d, float u, float v) { return vec2(m[0] * d.x + m[1] * d.y + u, m[3] * d.x + m[4] * d.y + v); };
    at.uv = moved(at.uv, m[2], m[5]);
    at.uv1 = moved(at.uv1, 0.0f, 0.0f);
    at.uv2 = moved(at.uv2, 0.0f, 0.0f);
    return at;
}

float number_of(float texel, float scale, float offset, float low, float high) { return std::min(std::max(offset + scale * texel, low), high); }

// The material of an object at a place: textures give some of its numbers.
Material material_at(const Object& o, const TexturePlace& at) {
    Material own = o;
@CASES@
    return own;
}

Material material_within(const Object& o, int triangle, vec3 b) { return o.textured < 0 ? Material(o) : material_at(o, place_within(o, triangle, b)); }
Material material_at_vertex(const Object& o, std::size_t v) { return o.textured < 0 ? Material(o) : material_at(o, place_at_vertex(o, v)); }

