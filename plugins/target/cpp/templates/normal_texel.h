vec3 normal_texel(const Object& o, int triangle, vec3 b) {
    return texture_at(o.normal_map.texture, placed(o.normal_map.placing, @PLACE@));
}

