
// How shadows read the opacity of an object, if it is not the same everywhere.
struct ShadowOpacity {
    std::size_t object;
    float scale, offset;
@CHANNEL_MEMBER@
@PICTURE_MEMBERS@
};
const std::vector<ShadowOpacity> k_shadow_opacities = {
@OPACITIES@};

GLint bits(float x) {
    GLint result = 0;
    std::memcpy(&result, &x, sizeof(x));
    return result;
}

// Two numbers of a vertex: where a picture has its opacity, or one that gives it.
std::array<float, 2> numbers_of(const ShadowOpacity& of, std::size_t vertex) {
    const MeshArrays& mesh = k_objects[of.object].mesh;
    std::array<float, 2> numbers = {0, 0};
    if (mesh.uv != nullptr) numbers = {mesh.uv[2 * vertex], mesh.uv[2 * vertex + 1]};
@READ_CHANNELS@
@PLACE@
    return numbers;
}

// Puts an opacity behind the tree: how it is made of a number, the picture that has it, and numbers of the corners of each triangle.
void add_opacity(const ShadowTree& tree, const ShadowOpacity& of, std::vector<std::array<GLint, 4>>& texels) {
    const Object& object = k_objects[of.object];
    const std::size_t use = texels.size();
    texels.push_back({bits(of.scale), bits(of.offset), bits(object.opacity_cutoff), 0});
    texels.push_back({0, 0, 0, 0});
@ADD_PICTURE@
    const int* place = tree.places;
    for (std::size_t i = 0; i < of.object; ++i) place += k_objects[i].mesh.triangles;
    for (std::size_t t = 0; t < object.mesh.triangles; ++t, ++place) {
        if (*place < 0) continue;
        const std::size_t at = 2 * tree.nodes + 3 * static_cast<std::size_t>(*place);
        texels[at + 1][3] = bits(-1.0f);
        texels[at + 2][3] = static_cast<GLint>(texels.size());
        std::array<GLint, 6> numbers{};
        for (std::size_t k = 0; k < 6; ++k) numbers[k] = bits(numbers_of(of, object.mesh.corners[3 * t + k / 2])[k % 2]);
        texels.push_back({numbers[0], numbers[1], numbers[2], numbers[3]});
        texels.push_back({numbers[4], numbers[5], static_cast<GLint>(use), 0});
    }
}
