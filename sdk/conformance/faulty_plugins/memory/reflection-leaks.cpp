// Allocates a table of 1 MiB that no destructor frees.
#include "faulty_reflection.h"

namespace {
class Leaks final : public faulty::Matt {
  public:
    explicit Leaks(const faulty::Params& params) : Matt(params), table_(new float[1 << 18]{params.kd.x}) {}

  private:
    float factor(const candela::SurfaceBatch& s, const candela::LightingBatch& light,
                 std::size_t i) const override {
        return Matt::factor(s, light, i) * (table_[i % 2] >= 0 ? 1.0f : 0.0f);
    }
    float* table_;
};
}  // namespace

FAULTY_PLUGIN(Leaks)
