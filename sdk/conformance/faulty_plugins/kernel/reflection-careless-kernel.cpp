#include "faulty_reflection.h"

// It computes correct values, but no program should be generated from its text.
FAULTY_KERNEL_PLUGIN(faulty::Matt, careless_kernel)
