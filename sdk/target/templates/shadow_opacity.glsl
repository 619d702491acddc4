
@PICTURE@
// The opacity where a ray meets a triangle, by the weights of its corners: a picture gives it, with its finest texels, or the
// vertices. The fourth number of the triangle's third texel: a texel with two numbers of each corner, texture coordinates, or one
// that gives the opacity. The next texel has the third corner's, and where two others say how the opacity is made of them: scale,
// offset, cutoff; width, height, place and continuation of a picture, whose texels are four to one of the tree's, or zeros.
float textured_blocked_part(int triangle, vec3 weights) {
    int place = tree_texel(triangle + 2).w;
    vec4 corners = intBitsToFloat(tree_texel(place));
    ivec4 third = tree_texel(place + 1);
    vec2 numbers = weights.x * corners.xy + weights.y * corners.zw + weights.z * intBitsToFloat(third.xy);
    vec3 use = intBitsToFloat(tree_texel(third.z).xyz);
    float number = numbers.x;
@LOOK_UP@
    float opacity = clamp(use.y + use.x * number, 0.0, 1.0);
    return use.z <= 0.0 ? opacity : (opacity >= use.z ? 1.0 : 0.0);
}
