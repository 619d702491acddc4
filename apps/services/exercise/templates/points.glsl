// The model's reflection at a point of a ball seen from far away along z.
layout(location = 0) in vec3 normal;
layout(location = 1) in vec3 tangent;

uniform vec3 point_color;
uniform vec3 point_to_light;

out vec3 ambient;
out vec3 diffuse;
out vec3 specular;

void main() {
#ifdef PREPARED_MATERIAL
    prepare_material();
#endif
    Surface s = Surface(normal, vec3(0.0, 0.0, 1.0), tangent, point_color, normal, vec2(0.0));
    ambient = reflect_ambient(s);
    Reflected factors = reflect_light(s, point_to_light);
    diffuse = factors.diffuse;
    specular = factors.specular;
    gl_Position = vec4(0.0);
}
