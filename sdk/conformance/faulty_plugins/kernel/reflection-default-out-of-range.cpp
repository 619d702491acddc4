// Has a default that a scene would refuse.
#include "faulty_reflection.h"

namespace {
class DefaultOutOfRange final : public faulty::Matt {
    using Matt::Matt;
};
constexpr auto k_wrong_fields = candela::sdk::fields(
    candela::sdk::coefficient(&faulty::Params::kd, "kd", 1.5f, "how much light is reflected diffusely"));
}  // namespace

CANDELA_PLUGIN(reflection, DefaultOutOfRange, k_wrong_fields,
               {.title = "Default out of range", .summary = "Bad on purpose."})
