#include "museum.h"

// Without fault, except for a variable that its author does not read yet.
MUSEUM_KERNEL_PIECE(museum::Matt, unfinished_kernel)
