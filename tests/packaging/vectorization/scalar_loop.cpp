// A batch loop that cannot be vectorised, because each step needs the previous one. The check must notice.
#include "candela/kernel/simd_dispatch.h"

#include <cstddef>

namespace {

struct ChainLoop {
    CANDELA_BATCH_LOOP static void run(std::size_t count, float* x) {
        for (std::size_t i = 1; i < count; ++i) x[i] = x[i] / (x[i - 1] + 1.0f);
    }
};

}  // namespace

void chain(std::size_t count, float* x) { candela::multiversion<ChainLoop>(count, x); }
