#include "museum.h"

// It computes correct values, but no program should be generated from its text.
MUSEUM_KERNEL_PIECE(museum::Matt, careless_kernel)
