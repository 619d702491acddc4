// Its kernel text is GLSL but not C++.
#include "museum.h"

MUSEUM_KERNEL_PIECE(museum::Matt, speaks_no_cpp)
