
#ifdef LIT_AT_FRAGMENT
uniform int picture_height;
uniform vec3 line_of_sight;  // at (0, 0) of gl_FragCoord; if orthographic, its distance from the eye
#ifndef TEXTURED
uniform vec3 pixel_right;
uniform vec3 pixel_up;
#endif
flat in vec3 at_corner;
// The place where the line of sight meets the triangle. Interpolation may miss the plane by more than rays keep away from surfaces,
// and edges of shadows show where it misses the line. A line that misses the triangle, because rasterisers round its corners, meets
// the plane beyond an edge, which in a hollow is behind the next triangle: there, the nearest place towards the middle is taken.
vec3 place_on_triangle() {
    place_per_x = dFdx(at_place);
    place_per_y = dFdy(at_place);
    normal_per_x = dFdx(at_vertex_normal);
    normal_per_y = dFdy(at_vertex_normal);
    seen_pixel = uvec2(int(gl_FragCoord.x), picture_height - 1 - int(gl_FragCoord.y));
    vec3 line = line_of_sight + gl_FragCoord.x * pixel_right + gl_FragCoord.y * pixel_up;
    vec3 from = is_orthographic ? eye + line : eye;
    vec3 along = is_orthographic ? -towards_observer : line;
    vec3 place = from + along * (dot(at_face_normal, at_corner - from) / dot(at_face_normal, along));
    // Triangles seen from the side also cover pixels whose line of sight misses them widely.
    float pixel = length(pixel_right) * (is_orthographic ? 1.0 : dot(towards_observer, eye - at_place));
    if (!(distance(place, at_place) < 4.0 * pixel)) place = at_place;
    mat2x3 edges = mat2x3(place_per_x, place_per_y) * inverse(mat2(dFdx(at_barycentric).xy, dFdy(at_barycentric).xy));
    vec2 weights = at_barycentric.xy + inverse(transpose(edges) * edges) * ((place - at_place) * edges);
    vec3 to_middle = edges * (1.0 / 3.0 - weights);
    float least = min(min(weights.x, weights.y), 1.0 - weights.x - weights.y);
    vec3 within = place + max(0.0, least / (least - 1.0 / 3.0)) * to_middle;
    if (distance(within, place) < 4.0 * pixel) {  // not if the triangle seems to be a line
        place = within;
        if (blocks_both_sides) seen_inward = 4.0 * normalize(to_middle);
    }
    return place - at_face_normal * dot(at_face_normal, place - at_corner);
}
#endif
