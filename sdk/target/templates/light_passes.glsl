
// The part of the light that a triangle blocks where a ray meets it.
float blocked_part;

// Of two triangles that share an edge, a ray through it meets the one that owns it, so that a surface which lets a part of the
// light through counts once.
bool owns_edge(float volume, vec3 edge, float whole) {
    if (volume != 0.0) return (volume > 0.0) == (whole > 0.0);
    vec3 e = whole > 0.0 ? edge : -edge;
    return e.x > 0.0 || (e.x == 0.0 && (e.y > 0.0 || (e.y == 0.0 && e.z > 0.0)));
}
