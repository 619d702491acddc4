// The part of the light that surfaces let pass where a ray meets them.
float passing(std::vector<Crossing>& crossings) {
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& p, const Crossing& q) {
        return p.object != q.object ? p.object < q.object : p.distance < q.distance;
    });
    float part = 1;
    for (std::size_t i = 0; i < crossings.size(); ++i) {
        const Crossing& c = crossings[i];
        // The triangles that share an edge are one surface there.
        if (i > 0 && crossings[i - 1].object == c.object && c.distance - crossings[i - 1].distance <= 1e-9 * c.distance) continue;
        part *= 1 - opacity_at(*c.object, c.triangle, c.weights, false);
    }
    return part;
}

