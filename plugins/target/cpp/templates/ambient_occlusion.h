struct AmbientOcclusion {
    int rays;        // 0: light from everywhere is not blocked
    float distance;  // nothing farther away blocks it, metres
};

// The fraction of light from everywhere that reaches a place: the mean over rays whose directions are distributed around the
// normal by the cosine.
float open_part(const ShadowPlace& at, const AmbientOcclusion& occlusion) {
    if (occlusion.rays == 0 || !at.object.receives_shadows) return 1.0f;
    // Two directions perpendicular to the normal (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
    const vec3 n = at.normal;
    const float sign = n.z < 0 ? -1.0f : 1.0f, a = -1.0f / (sign + n.z), b = n.x * n.y * a;
    const vec3 tangent(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x), bitangent(b, sign + n.y * n.y * a, -n.y);
    const vec2 offset = @OFFSET@;
    const auto rays = static_cast<float>(occlusion.rays);
    float sum = 0;
    for (int ray = 0; ray < occlusion.rays; ++ray) {
        const auto k = static_cast<float>(ray);
        const float square = (k + 0.5f + offset.x) / rays, turn = 0.61803399f * k + 0.5f + offset.y;
        const float angle = 6.2831853f * (turn - std::floor(turn)), radius = std::sqrt(square);
        const vec3 direction = radius * std::cos(angle) * tangent + radius * std::sin(angle) * bitangent + std::sqrt(1.0f - square) * n;
        sum += unblocked(at, direction, occlusion.distance);
    }
    return sum / rays;
}
