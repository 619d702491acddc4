// Its kernel text is another formula than what it computes.
#include "museum.h"

MUSEUM_KERNEL_PIECE(museum::Matt, says_otherwise)
