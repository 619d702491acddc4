// Its kernel text is C++ but not GLSL.
#include "museum.h"

MUSEUM_KERNEL_PIECE(museum::Matt, speaks_no_glsl)
