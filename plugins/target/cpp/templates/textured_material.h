// The material of an object at a place: textures give some of its numbers.
Material material_at(const Object& o, const TexturePlace& at) {
    Material own = o;
@CASES@
    return own;
}

Material material_within(const Object& o, int triangle, vec3 b) { return o.textured < 0 ? Material(o) : material_at(o, place_within(o, triangle, b)); }
Material material_at_vertex(const Object& o, std::size_t v) { return o.textured < 0 ? Material(o) : material_at(o, place_at_vertex(o, v)); }

