// The intensity that a reflection model sends into a direction, of one light's arriving at a point.
layout(location = 0) in vec3 direction;

uniform vec3 lobe_normal;
uniform vec3 lobe_tangent;
uniform vec3 lobe_color;
uniform vec3 lobe_position;
uniform vec3 lobe_to_light;
uniform vec3 lobe_diffuse;
uniform vec3 lobe_specular;

out vec3 reflected;

void main() {
#ifdef PREPARED_MATERIAL
    prepare_material();
#endif
    Surface s = Surface(lobe_normal, direction, lobe_tangent, lobe_color, lobe_position, vec2(0.0));
    Reflected factors = reflect_light(s, lobe_to_light);
    reflected = factors.diffuse * lobe_diffuse + factors.specular * lobe_specular;
    gl_Position = vec4(0.0);
}
