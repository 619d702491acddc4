uniform vec3 eye;
uniform bool is_orthographic;
uniform vec3 towards_observer;

// The intensity that a point of a surface sends to the observer. `color` multiplies the object's colour; `facing`:
// -1 where an open surface is seen from behind.
vec3 intensity_at(vec3 place, ShadingPoint point, vec3 color, float facing) {
@PREPARATION@
    Surface s;
@NORMAL@
    s.to_observer = is_orthographic ? towards_observer : normalize(eye - place);
    s.tangent = vec3(0.0);
#ifdef NEEDS_TANGENT
    s.tangent = normalize(point.dpdu - s.normal * dot(s.normal, point.dpdu));
#endif
    s.color = @COLOR@ * color;
    s.position = vec3(0.0);
#ifdef NEEDS_POSITION
    s.position = place;
#endif
    s.uv = vec2(0.0);
#ifdef NEEDS_UV
    s.uv = point.uv;
#endif
@SEEN_SIDE@
    return lights_at(s, Receiver(place, s.normal))@EMISSION@;
}
