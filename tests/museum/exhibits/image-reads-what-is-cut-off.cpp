// Leaves the missing part of a truncated file black without an error.
#include "museum_image.h"

namespace {
class ReadsWhatIsCutOff final : public museum::Runs {
    using Runs::Runs;
    bool minds_the_end() const override { return false; }
};
}  // namespace

MUSEUM_RUNS(ReadsWhatIsCutOff)
