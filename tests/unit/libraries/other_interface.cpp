// A valid reflection model, built against the interface version CANDELA_TEST_INTERFACE. The environment
// records how far a host got with it.
#include <cstdlib>

#include "candela/reflection_plugin.h"

#undef CANDELA_INTERFACE_VERSION
#define CANDELA_INTERFACE_VERSION CANDELA_TEST_INTERFACE

namespace {

[[maybe_unused]] const int loaded = ::setenv("CANDELA_TEST_OTHER_INTERFACE", "loaded", 1);

class OtherInterface final : public candela::ReflectionModel {
  public:
    explicit OtherInterface(const candela::sdk::NoParams&) {
        ::setenv("CANDELA_TEST_OTHER_INTERFACE", "made", 1);
    }
    void reflect(const candela::SurfaceBatch&, const candela::LightingBatch&,
                 const candela::ReflectedBatch&) const override {}
    void reflect_ambient(const candela::SurfaceBatch&, const candela::ConstVec3Span&,
                         const candela::ReflectedBatch&) const override {}
};

}  // namespace

CANDELA_PLUGIN(reflection, OtherInterface, candela::sdk::k_no_fields, {.title = "Other interface"})
