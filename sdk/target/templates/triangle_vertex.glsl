
#ifdef NEEDS_TRIANGLE
layout(location = 9) in vec3 p0;
layout(location = 10) in vec3 p1;
layout(location = 11) in vec3 p2;
layout(location = 12) in vec3 n0;
layout(location = 13) in vec3 n1;
layout(location = 14) in vec3 n2;
#ifdef LIT_AT_FRAGMENT
flat out vec3 at_p0;
flat out vec3 at_p1;
flat out vec3 at_p2;
flat out vec3 at_n0;
flat out vec3 at_n1;
flat out vec3 at_n2;
void pass_triangle() {
    at_p0 = p0;
    at_p1 = p1;
    at_p2 = p2;
    at_n0 = n0;
    at_n1 = n1;
    at_n2 = n2;
}
#else
void pass_triangle() { seen_triangle = Triangle(p0, p1, p2, n0, n1, n2); }
#endif
#endif
