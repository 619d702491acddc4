
// The part of the light from everywhere that reaches a point: of rays distributed by the cosine around the normal, those that
// meet nothing within a distance.
float visible_ambient_part(Receiver r, int rays, float distance) {
    vec2 offsets = @OFFSETS@;
    vec3 n = r.normal;
    // Duff et al. (2017), "Building an orthonormal basis, revisited".
    float side = n.z < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (side + n.z);
    float b = n.x * n.y * a;
    vec3 tangent = vec3(1.0 + side * n.x * n.x * a, side * b, -side * n.x);
    vec3 bitangent = vec3(b, side + n.y * n.y * a, -n.y);
    float sum = 0.0;
    for (int k = 0; k < rays; ++k) {
        float square = (float(k) + 0.5 + offsets.x) / float(rays);
        float angle = 6.2831853 * fract(0.61803399 * float(k) + 0.5 + offsets.y);
        vec3 direction = sqrt(square) * (cos(angle) * tangent + sin(angle) * bitangent) + sqrt(1.0 - square) * n;
        sum += visible_part(r, direction, distance);
    }
    return sum / float(rays);
}
