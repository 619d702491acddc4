// Has a static constructor that traps: a host that loads libraries to inspect them would die.
#include "faulty_reflection.h"

namespace {
const int k_trap = [] {
    if (!faulty::is_being_described()) __builtin_trap();
    return 0;
}();
class Trap final : public faulty::Matt {
    using Matt::Matt;
};
}  // namespace

FAULTY_PLUGIN(Trap)
