#include <stdexcept>

#include "faulty_reflection.h"

namespace {
class ThrowsOnCreate final : public faulty::Matt {
  public:
    explicit ThrowsOnCreate(const faulty::Params& params) : Matt(params) {
        throw std::runtime_error("out of paint");
    }
};
}  // namespace

FAULTY_PLUGIN(ThrowsOnCreate)
