// A reader that writes one number past the end of the picture.
#include "faulty_image.h"

namespace {
class WritesBehindWhatItReads final : public faulty::Runs {
    using Runs::Runs;
    void read(const char* path, candela::ImageSink& sink) const override {
        class Keeping final : public candela::ImageSink {
          public:
            explicit Keeping(candela::ImageSink& to) : to_(to) {}
            std::span<float> allocate(int width, int height, bool is_encoded) override {
                return values = to_.allocate(width, height, is_encoded);
            }
            std::span<float> values;

          private:
            candela::ImageSink& to_;
        } keeping(sink);
        Runs::read(path, keeping);
        *(keeping.values.data() + keeping.values.size()) = 1;
    }
};
}  // namespace

FAULTY_RUNS(WritesBehindWhatItReads)
