
float shadow_picture_texel(int first, int number) {
    return float(tree_texel(first + (number >> 2))[number & 3]) / 65535.0;
}

// The opacity that a texture gives where a ray meets a triangle, by the weights of its corners, with the finest texels. The fourth
// number of its third texel: a texel with texture coordinates of its corners; the next one has the third corner's, and where two
// texels say how the picture is read and where it is, four texels of the picture in each of the tree's.
float textured_blocked_part(int triangle, vec3 weights) {
    int place = tree_texel(triangle + 2).w;
    vec4 corners = intBitsToFloat(tree_texel(place));
    ivec4 third = tree_texel(place + 1);
    vec2 uv = weights.x * corners.xy + weights.y * corners.zw + weights.z * intBitsToFloat(third.xy);
    vec3 use = intBitsToFloat(tree_texel(third.z).xyz);  // scale, offset, cutoff
    ivec4 picture = tree_texel(third.z + 1);
    ColorTexture t = ColorTexture(picture.x, picture.y, 1, picture.w % 3, picture.w / 3, -picture.z);
    float opacity = clamp(use.y + use.x * color_texture_in_level(t, 0, uv).r, 0.0, 1.0);
    return use.z <= 0.0 ? opacity : (opacity >= use.z ? 1.0 : 0.0);
}
