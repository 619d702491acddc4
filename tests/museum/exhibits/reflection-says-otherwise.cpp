// Its kernel text is not the formula that it computes.
#include "museum.h"

MUSEUM_KERNEL_PIECE(museum::Matt, says_otherwise)
