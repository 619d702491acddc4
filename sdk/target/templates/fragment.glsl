
#ifdef LIT_AT_FRAGMENT
in vec3 at_place;
in vec3 at_vertex_normal;
flat in vec3 at_face_normal;
in vec2 at_uv;
in vec3 at_dpdu;
in vec3 at_dpdv;
in vec3 at_barycentric;
in vec3 at_vertex_color;
#else
INTENSITY_RATE in vec3 front;
INTENSITY_RATE in vec3 back;
#endif

@DEPTH_UNIFORM@
@SHADOW_PLACE@
@LAYER_UNIFORMS@

layout(location = 0) out vec4 intensity;

void main() {
@DEPTH@
#ifdef LIT_AT_FRAGMENT
@READ_TRIANGLE@
    ShadingPoint point = ShadingPoint(at_face_normal, at_vertex_normal, at_barycentric, at_uv, at_dpdu, at_dpdv);
#ifdef TWO_SIDED
    float facing = gl_FrontFacing ? 1.0 : -1.0;
#else
    float facing = 1.0;
#endif
    vec3 color = at_vertex_color;
@MATERIAL@
    intensity = vec4(intensity_at(@PLACE@, point, color, facing), 1.0);
#else
    intensity = vec4(gl_FrontFacing ? front : back, 1.0);
#endif
@COVER@
}
