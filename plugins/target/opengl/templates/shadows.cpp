// The line of sight at the picture's lower left corner, and its change from pixel to pixel.
void set_sight(GLuint program, const Observer& observer, const View& view, int width, int height, std::array<float, 2> sample) {
    const float all = observer.is_perspective ? 2 * std::tan(0.5f * observer.size * 0.0174532925f) : observer.size;
    const float pixel = all / static_cast<float>(height);
    const float x = sample[0] - 0.5f - 0.5f * static_cast<float>(width), y = 0.5f - sample[1] - 0.5f * static_cast<float>(height);
    const vec3 corner = (pixel * x) * view.right + (pixel * y) * view.top;
    set(program, {"line_of_sight", Uniform::vector, observer.is_perspective ? view.forward + corner : corner});
    set(program, {"pixel_right", Uniform::vector, pixel * view.right});
    set(program, {"pixel_up", Uniform::vector, pixel * view.top});
}

@TEXTURED_OPACITY@
// The tree of the triangles that block light, as shaders read it: nodes, whose boxes are found here, then triangles.
GLuint shadow_texture() {
    const ShadowTree tree = shadow_tree();
    const std::size_t width = @WIDTH@, first = 2 * tree.nodes, height = (first + 3 * tree.triangles) / width + 1;
    std::vector<std::array<GLint, 4>> texels(width * height);
    const auto put = [&](std::size_t texel, const float* position) { std::memcpy(&texels[texel], position, 3 * sizeof(float)); };
    const int* place = tree.places;
    for (std::size_t i = 0; i < k_objects.size(); ++i) {
        const MeshArrays& mesh = k_objects[i].mesh;
@SHADOW_OPACITY@
        for (std::size_t t = 0; t < mesh.triangles; ++t, ++place) {
            if (*place < 0) continue;
            const std::size_t at = first + 3 * static_cast<std::size_t>(*place);
            for (std::size_t k = 0; k < 3; ++k) put(at + k, mesh.position + 3 * std::size_t{mesh.corners[3 * t + k]});
            texels[at][3] = static_cast<GLint>(2 * i) + (k_objects[i].is_solid ? 1 : 0);
@PUT_OPACITY@
        }
    }
@ADD_OPACITY@
    // Children come after their parents.
    std::vector<std::array<vec3, 2>> boxes(tree.nodes);
    for (std::size_t node = tree.nodes; node-- > 0;) {
        vec3 low = {1e38f, 1e38f, 1e38f}, high = -1.0f * low;
        const auto include = [&](const vec3& a, const vec3& b) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                low[axis] = std::min(low[axis], a[axis]);
                high[axis] = std::max(high[axis], b[axis]);
            }
        };
        const int next = tree.links[2 * node], leaf = tree.links[2 * node + 1];
        if (leaf < 0) {
            const auto second = static_cast<std::size_t>(tree.links[2 * (node + 1)]);
            for (const std::size_t child : {node + 1, second}) include(boxes[child][0], boxes[child][1]);
        }
        for (int texel = leaf >> 3; leaf >= 0 && texel < (leaf >> 3) + 3 * (leaf & 7); ++texel) {
            vec3 corner;
            std::memcpy(&corner, &texels[static_cast<std::size_t>(texel)], sizeof(corner));
            include(corner, corner);
        }
        boxes[node] = {low, high};
        put(2 * node, low.data());
        put(2 * node + 1, high.data());
        texels[2 * node][3] = next;
        texels[2 * node + 1][3] = leaf;
    }
    return data_texture(GL_RGBA32I, width, texels.size() / width, GL_RGBA_INTEGER, GL_INT, texels.data());
}
