
// How shadows read the texture that gives an object's opacity.
struct ShadowOpacity {
    std::size_t object, texture, channel;
    int wrap_u, wrap_v;
    std::array<float, 6> placing;  // of texture coordinates: a row for u and one for v
    float scale, offset;
};
const std::vector<ShadowOpacity> k_shadow_opacities = {
@OPACITIES@};

GLint bits(float x) {
    GLint result = 0;
    std::memcpy(&result, &x, sizeof(x));
    return result;
}

// Puts these opacities behind the tree: the picture, after how it is read, and texture coordinates for each triangle.
void add_textured_opacity(const ShadowTree& tree, const ShadowOpacity& of, std::vector<std::array<GLint, 4>>& texels) {
    const Object& object = k_objects[of.object];
    const TextureLevel picture = read_ppm(k_textures[of.texture]);
    const std::size_t use = texels.size(), count = picture.texels.size() / 4;
    texels.push_back({bits(of.scale), bits(of.offset), bits(object.opacity_cutoff), 0});
    texels.push_back({picture.width, picture.height, static_cast<GLint>(use + 2), of.wrap_u + 3 * of.wrap_v});
    texels.resize(use + 2 + (count + 3) / 4);
    for (std::size_t i = 0; i < count; ++i) texels[use + 2 + i / 4][i % 4] = picture.texels[4 * i + of.channel];
    const int* place = tree.places;
    for (std::size_t i = 0; i < of.object; ++i) place += k_objects[i].mesh.triangles;
    for (std::size_t t = 0; t < object.mesh.triangles; ++t, ++place) {
        if (*place < 0) continue;
        const std::size_t at = 2 * tree.nodes + 3 * static_cast<std::size_t>(*place);
        texels[at + 1][3] = bits(-1.0f);
        texels[at + 2][3] = static_cast<GLint>(texels.size());
        std::array<GLint, 6> uv{};
        for (std::size_t k = 0; k < 6; ++k) {
            const float* const from = object.mesh.uv + 2 * std::size_t{object.mesh.corners[3 * t + k / 2]};
            const float* const row = &of.placing[3 * (k % 2)];
            uv[k] = bits(object.mesh.uv == nullptr ? row[2] : row[0] * from[0] + row[1] * from[1] + row[2]);
        }
        texels.push_back({uv[0], uv[1], uv[2], uv[3]});
        texels.push_back({uv[4], uv[5], static_cast<GLint>(use), 0});
    }
}
