#include <unistd.h>

#include <thread>

#include "faulty_reflection.h"

namespace {
class LeavesAThread final : public faulty::Matt {
  public:
    explicit LeavesAThread(const faulty::Params& params) : Matt(params) {
        std::thread([] {
            for (;;) ::pause();
        }).detach();
    }
};
}  // namespace

FAULTY_PLUGIN(LeavesAThread)
