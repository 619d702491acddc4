
#if defined(NEEDS_TRIANGLE) && defined(LIT_AT_FRAGMENT)
flat in vec3 at_p0;
flat in vec3 at_p1;
flat in vec3 at_p2;
flat in vec3 at_n0;
flat in vec3 at_n1;
flat in vec3 at_n2;
void read_triangle() { seen_triangle = Triangle(at_p0, at_p1, at_p2, at_n0, at_n1, at_n2); }
#endif
