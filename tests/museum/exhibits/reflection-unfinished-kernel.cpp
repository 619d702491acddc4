#include "museum.h"

// Sound, but for a variable that its author has not got to reading yet.
MUSEUM_KERNEL_PIECE(museum::Matt, unfinished_kernel)
