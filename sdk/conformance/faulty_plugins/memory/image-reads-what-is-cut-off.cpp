// Leaves the missing part of a truncated file black without an error.
#include "faulty_image.h"

namespace {
class ReadsWhatIsCutOff final : public faulty::Runs {
    using Runs::Runs;
    bool minds_the_end() const override { return false; }
};
}  // namespace

FAULTY_RUNS(ReadsWhatIsCutOff)
