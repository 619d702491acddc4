
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 place;
layout(location = 2) in vec3 vertex_normal;
layout(location = 3) in vec3 face_normal;
layout(location = 4) in vec2 uv;
layout(location = 5) in vec3 dpdu;
layout(location = 6) in vec3 dpdv;
layout(location = 7) in vec3 barycentric;
layout(location = 8) in vec3 vertex_color;

uniform mat4 view_projection;

#ifdef LIT_AT_FRAGMENT
out vec3 at_place;
out vec3 at_vertex_normal;
flat out vec3 at_face_normal;
out vec2 at_uv;
out vec3 at_dpdu;
out vec3 at_dpdv;
out vec3 at_barycentric;
out vec3 at_vertex_color;
@CORNER@
#else
INTENSITY_RATE out vec3 front;
INTENSITY_RATE out vec3 back;
#endif

void main() {
    gl_Position = view_projection * vec4(position, 1.0);
@PASS_TRIANGLE@
@PASS_OPACITY@
#ifdef LIT_AT_FRAGMENT
    at_place = place;
    at_vertex_normal = vertex_normal;
    at_face_normal = face_normal;
    at_uv = uv;
    at_dpdu = dpdu;
    at_dpdv = dpdv;
    at_barycentric = barycentric;
    at_vertex_color = vertex_color;
@PASS_CORNER@
@PASS_TEXTURE@
@PASS_CHANNELS@
#else
    vec3 color = vertex_color;
@MATERIAL@
    ShadingPoint point = ShadingPoint(face_normal, vertex_normal, barycentric, uv, dpdu, dpdv);
    front = intensity_at(place, point, color, 1.0);
#ifdef TWO_SIDED
    back = intensity_at(place, point, color, -1.0);
#else
    back = front;
#endif
#endif
}
