// GLSL leaves the precision of these to the driver; some have 11 bits, which moves the rim of a cone or of a highlight.
// Here they are exact to a few units of a float's last bit.
float exact_sin(float x) {
    float n = floor(0.318309886 * x + 0.5);
    float r = ((x - n * 3.140625) - n * 9.67502593994e-4) - n * 1.50995799e-7;  // x - n pi
    float z = r * r;
    float p = (((2.6052249168e-6 * z - 0.00019809075306) * z + 0.008333051064) * z - 0.16666657992) * z + 1.0;
    return mod(n, 2.0) == 0.0 ? r * p : -r * p;
}
float exact_cos(float x) { return exact_sin(x + 1.57079633); }
float asin_of_small(float t) {  // t from 0 to 1/2
    float z = t * t;
    return t * ((((0.050653528257 * z + 0.039647069538) * z + 0.075476364806) * z + 0.16665105905) * z + 1.0000000814);
}
float exact_acos(float x) {
    float a = min(abs(x), 1.0);
    float of_a = a > 0.5 ? 2.0 * asin_of_small(sqrt(0.5 - 0.5 * a)) : 1.57079633 - asin_of_small(a);
    return x < 0.0 ? 3.14159265 - of_a : of_a;
}
float exact_asin(float x) { return 1.57079633 - exact_acos(x); }
#define OF_VECTORS(f) \
    vec2 f(vec2 v) { return vec2(f(v.x), f(v.y)); } \
    vec3 f(vec3 v) { return vec3(f(v.x), f(v.y), f(v.z)); } \
    vec4 f(vec4 v) { return vec4(f(v.x), f(v.y), f(v.z), f(v.w)); }
OF_VECTORS(exact_sin)
OF_VECTORS(exact_cos)
OF_VECTORS(exact_acos)
OF_VECTORS(exact_asin)
#define sin exact_sin
#define cos exact_cos
#define acos exact_acos
#define asin exact_asin

