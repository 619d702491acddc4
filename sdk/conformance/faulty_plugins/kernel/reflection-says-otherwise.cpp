// Its kernel text is not the formula that it computes.
#include "faulty_reflection.h"

FAULTY_KERNEL_PLUGIN(faulty::Matt, says_otherwise)
