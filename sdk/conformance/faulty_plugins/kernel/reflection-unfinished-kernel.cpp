#include "faulty_reflection.h"

// Without fault, except for a variable that its author does not read yet.
FAULTY_KERNEL_PLUGIN(faulty::Matt, unfinished_kernel)
