// Has a static constructor that traps: a host that loads libraries to inspect them would die.
#include "museum.h"

namespace {
const int k_trap = [] {
    if (!museum::is_being_described()) __builtin_trap();
    return 0;
}();
class Trap final : public museum::Matt {
    using Matt::Matt;
};
}  // namespace

MUSEUM_PIECE(Trap)
