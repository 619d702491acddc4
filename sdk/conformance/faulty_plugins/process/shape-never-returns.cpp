#include <unistd.h>

#include "candela/shape_plugin.h"

namespace {
class NeverReturns final : public candela::Shape {
  public:
    explicit NeverReturns(const candela::sdk::NoParams&) {}
    void tessellate(const candela::MeshRequest&, candela::MeshSink&) const override {
        for (;;) ::pause();
    }
};
constexpr candela::Property k_properties[] = {{"closed"}};
}  // namespace

CANDELA_PLUGIN(shape, NeverReturns, candela::sdk::k_no_fields,
               {.title = "Never returns", .summary = "Bad on purpose.", .properties = k_properties})
