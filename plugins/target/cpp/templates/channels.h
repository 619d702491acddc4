// A number of the mesh's vertices there.
float channel_at(const TexturePlace& at, std::size_t channel) {
    const std::vector<float>& values = at.mesh->channels[channel];
    return at.triangle < 0 ? values[at.vertex] : blend(values, *at.mesh, at.triangle, at.weights);
}

// The same place by the second texture coordinates.
TexturePlace on_second_uv(TexturePlace at) {
    at.uv = vec2(channel_at(at, 0), channel_at(at, 1));
    if (!at.is_pixel) return at;
    const int* const v = &at.mesh->corners[3 * static_cast<std::size_t>(at.triangle)];
    const auto edge = [&](int k) {
        const auto change = [&](std::size_t channel) {
            const std::vector<float>& values = at.mesh->channels[channel];
            return values[static_cast<std::size_t>(v[k])] - values[static_cast<std::size_t>(v[0])];
        };
        return vec2(change(0), change(1));
    };
    at.uv1 = edge(1);
    at.uv2 = edge(2);
    return at;
}
