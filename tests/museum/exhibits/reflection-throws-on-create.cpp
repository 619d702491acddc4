#include <stdexcept>

#include "museum.h"

namespace {
class ThrowsOnCreate final : public museum::Matt {
  public:
    explicit ThrowsOnCreate(const museum::Params& params) : Matt(params) {
        throw std::runtime_error("out of paint");
    }
};
}  // namespace

MUSEUM_PIECE(ThrowsOnCreate)
