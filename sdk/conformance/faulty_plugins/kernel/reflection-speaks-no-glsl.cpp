// Its kernel text is C++ but not GLSL.
#include "faulty_reflection.h"

FAULTY_KERNEL_PLUGIN(faulty::Matt, speaks_no_glsl)
