// Any bytes as a scene file.
#include "fuzz/fuzz.h"
#include "support/plugins.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    candela::SceneRequest request;
    request.files = {fuzz::written("scene.toml", fuzz::text_of(data, size))};
    request.use_defaults = true;
    candela::Diagnostics diagnostics;
    const auto scene = candela::read_scene(request, test_registry(), diagnostics);
    fuzz::check_diagnostics(diagnostics, scene.has_value());
    if (scene) fuzz::check_finite(*scene);
    return 0;
}
