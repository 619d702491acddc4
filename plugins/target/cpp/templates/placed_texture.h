vec3 texture_at(ColorTexture t, const TexturePlace& at) {
    const vec2 size(static_cast<float>(color_texture_width(t, 0)), static_cast<float>(color_texture_height(t, 0)));
    const float level =
        at.is_pixel ? color_texture_level(at.edge1, at.edge2, at.uv1, at.uv2, at.line, at.pixel * k_right, at.pixel * k_top, size) : 0.0f;
    return color_texture_at(t, at.uv, level);
}

TexturePlace placed(const Placing& m, TexturePlace at) {
    const auto moved = [&](vec2 d, float u, float v) { return vec2(m[0] * d.x + m[1] * d.y + u, m[3] * d.x + m[4] * d.y + v); };
    at.uv = moved(at.uv, m[2], m[5]);
    at.uv1 = moved(at.uv1, 0.0f, 0.0f);
    at.uv2 = moved(at.uv2, 0.0f, 0.0f);
    return at;
}

