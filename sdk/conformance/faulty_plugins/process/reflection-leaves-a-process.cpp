// Starts a process that leaves the session, and does not wait for it.
#include <unistd.h>

#include "faulty_reflection.h"

namespace {
class LeavesAProcess final : public faulty::Matt {
  public:
    explicit LeavesAProcess(const faulty::Params& params) : Matt(params) {
        static const bool has_left_one = leave_one();
        static_cast<void>(has_left_one);
    }

  private:
    static bool leave_one() {
        if (::fork() != 0) return true;
        ::setsid();
        for (;;) ::pause();
    }
};
}  // namespace

FAULTY_PLUGIN(LeavesAProcess)
