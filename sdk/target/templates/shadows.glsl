
// Shadows: a ray from the point to each light, through a tree of boxes around the triangles that block light. `shadow_tree`
// holds it, positions as bits of floats. A node is two texels, the low and the high corner of its box. The fourth number of
// the first: the node at which a ray goes on that misses the box, or that has met the node's triangles; -1: none. Of the
// second: -1 if the node has children, the first of which follows it; otherwise 8 times the first texel of its triangles plus
// their number. A triangle is three texels, its vertices. The fourth number of the first: twice its object's number, plus 1 if
// the object is solid, that is closed with nothing inside.@OPACITY_COMMENT@
uniform highp isampler2D shadow_tree;
uniform float least_margin;
uniform int object_index;
uniform bool is_shadowed;        // whether light is blocked on this object
uniform bool blocks_both_sides;  // whether this object is not solid
uniform vec3 object_middle;      // of the box around it

// Where light is evaluated.
uvec2 seen_pixel = uvec2(0u);  // from the top left of the picture; (0, 0) at vertices and faces
vec3 seen_side;                // the triangle's normal on the visible side; at a vertex the vertex's
float seen_facing;             // -1 where an open surface is seen from behind
vec3 seen_inward = vec3(0.0);  // along the surface: how many margins further rays start
// The place and the vertex normals, interpolated, change by this much from pixel to pixel; by nothing at vertices and faces.
vec3 place_per_x = vec3(0.0);
vec3 place_per_y = vec3(0.0);
vec3 normal_per_x = vec3(0.0);
vec3 normal_per_y = vec3(0.0);

const float k_infinitely_far = 3.0e38;

ivec4 tree_texel(int at) { return texelFetch(shadow_tree, ivec2(at & @LAST_COLUMN@, at >> @ROW_BITS@), 0); }
vec3 tree_position(int at) { return intBitsToFloat(tree_texel(at).xyz); }

// A solid object blocks light where the ray enters it; other surfaces block it on both sides. A ray that starts below the
// surface may leave its own object: there the shading normal faces the light and the triangle does not, as at the edge of the
// lit side of a coarse mesh.
bool is_let_through(int owner, float cosine, bool is_below) {
    bool is_solid = (owner & 1) != 0;
    bool is_own = (owner >> 1) == object_index;
    return is_solid ? cosine >= 0.0 : is_own && is_below && cosine * seen_facing >= 0.0;
}

@PASSING@
// By the signs of the volumes between the ray and the triangle's edges. Two triangles compute the same volume for the edge that
// they share, so that no ray slips through between them.
bool triangle_blocks(int triangle, vec3 from, vec3 direction, float reach, bool is_below) {
    ivec4 first = tree_texel(triangle);
    vec3 a = intBitsToFloat(first.xyz) - from;
    vec3 b = tree_position(triangle + 1) - from;
    vec3 c = tree_position(triangle + 2) - from;
    vec3 to_c = c - a;
    vec3 to_a = a - b;
    vec3 to_b = b - c;
    float u = dot(cross(to_c, c + a), direction);
    float v = dot(cross(to_a, a + b), direction);
    float w = dot(cross(to_b, b + c), direction);
    float rounding = 1.1920929e-7 * abs(u + v + w);
    if (min(min(u, v), w) < -rounding && max(max(u, v), w) > rounding) return false;
@OWNS_EDGES@
    vec3 normal = cross(to_c, to_a);
    float cosine = dot(normal, direction);  // times lengths
    if (cosine == 0.0 || is_let_through(first.w, cosine, is_below)) return false;
    float along = dot(normal, a) / cosine;
@BLOCKED_PART@
    return @IS_MET@;
}

float free_part(vec3 from, vec3 direction, float reach, bool is_below) {
@LEFT@
    vec3 inverse = 1.0 / mix(direction, vec3(1.0e-18), lessThan(abs(direction), vec3(1.0e-18)));
    for (int node = 0; node >= 0;) {
        ivec4 low = tree_texel(2 * node);
        ivec4 high = tree_texel(2 * node + 1);
        vec3 to_low = (intBitsToFloat(low.xyz) - from) * inverse;
        vec3 to_high = (intBitsToFloat(high.xyz) - from) * inverse;
        vec3 nearest = min(to_low, to_high);
        vec3 farthest = max(to_low, to_high);
        float enters = max(max(nearest.x, nearest.y), max(nearest.z, 0.0));
        float leaves = min(min(farthest.x, farthest.y), min(farthest.z, reach));
        bool meets = enters <= 1.000001 * leaves;  // or misses it by rounding
        if (meets && high.w < 0) {
            ++node;
            continue;
        }
        int triangle = high.w >> 3;
        int end = meets ? triangle + 3 * (high.w & 7) : triangle;
        for (; triangle < end; triangle += 3) {
            if (triangle_blocks(triangle, from, direction, reach, is_below)) @BLOCKED@
        }
        node = low.w;
    }
    return @FREE@;
}

// Whether the normal turns away from a light as one moves towards it: the surface is hollow there, rises towards the light and
// blocks it, even if the triangle on which the ray would start below does not.
bool is_hollow(vec3 to_light) {
    float turn = dot(to_light, cross(place_per_y, seen_side)) * dot(normal_per_x, to_light)
        + dot(to_light, cross(seen_side, place_per_x)) * dot(normal_per_y, to_light);
    return seen_facing * turn * dot(seen_side, cross(place_per_x, place_per_y)) < 0.0;
}

bool lights_below_horizon();

// The part of the light from a direction that reaches a point@ZERO_OR_ONE@.
float visible_part(Receiver r, vec3 to_light, float distance) {
    if (!lights_below_horizon() && dot(r.normal, to_light) <= 0.0) return 1.0;
    vec3 p = abs(r.position);
    float margin = max(least_margin, 9.5367432e-7 * max(max(p.x, p.y), p.z));
    float reach = 0.999999 * distance - 2.0 * margin;
    if (reach <= 2.0 * margin) return 1.0;
    float cosine = dot(r.normal, to_light);
    // Light that only models ask for that wrap it around always comes from below, whichever way the triangle faces.
    bool is_below = cosine < 0.0 || (dot(seen_side, to_light) < 0.0 && !is_hollow(to_light));
    // Above the surface and a little before the point, so that walls that meet in it are in the way; or below and after it.
    vec3 shift = (is_below ? -margin : margin) * (2.0 * seen_side - to_light);
    // In the edge of a room, that is behind the adjacent wall; so rays also start further inside their triangle, or their object.
    shift += margin * seen_inward;
    return free_part(r.position + shift, to_light - shift / distance, reach, is_below);
}

float visible_part(Receiver r, Incident incident, float distance) {
    bool is_lit = dot(incident.diffuse + incident.specular, vec3(1.0)) > 0.0;
    return is_lit ? visible_part(r, incident.to_light, distance) : 1.0;
}
