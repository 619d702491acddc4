#include <unistd.h>

#include <thread>

#include "museum.h"

namespace {
class LeavesAThread final : public museum::Matt {
  public:
    explicit LeavesAThread(const museum::Params& params) : Matt(params) {
        std::thread([] {
            for (;;) ::pause();
        }).detach();
    }
};
}  // namespace

MUSEUM_PIECE(LeavesAThread)
