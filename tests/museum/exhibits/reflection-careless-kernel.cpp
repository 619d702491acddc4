#include "museum.h"

// What it computes is sound; its text is not what programs should be generated from.
MUSEUM_KERNEL_PIECE(museum::Matt, careless_kernel)
