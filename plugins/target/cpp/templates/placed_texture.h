TexturePlace placed(const Placing& m, TexturePlace at) {
    const auto moved = [&](vec2 d, float u, float v) { return vec2(m[0] * d.x + m[1] * d.y + u, m[3] * d.x + m[4] * d.y + v); };
    at.uv = moved(at.uv, m[2], m[5]);
    at.uv1 = moved(at.uv1, 0.0f, 0.0f);
    at.uv2 = moved(at.uv2, 0.0f, 0.0f);
    return at;
}

