// Correct for pictures with few equal pixels in a row, but writes a run of 255 as a run of 1.
#include "faulty_image.h"

namespace {
class MiscountsLongRuns final : public faulty::Runs {
    using Runs::Runs;
    std::size_t count_for(std::size_t pixels) const override { return pixels == 255 ? 1 : pixels; }
    bool minds_the_end() const override { return false; }
};
}  // namespace

FAULTY_RUNS(MiscountsLongRuns)
