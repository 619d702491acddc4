// Its kernel text is GLSL but not C++.
#include "faulty_reflection.h"

FAULTY_KERNEL_PLUGIN(faulty::Matt, speaks_no_cpp)
