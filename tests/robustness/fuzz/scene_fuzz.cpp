// Arbitrary bytes as a scene file, next to a picture, `a.ppm`.
#include <set>

#include "robustness/fuzz/fuzz.h"
#include "support/plugins.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const bool is_there = !fuzz::written("a.ppm", "P6 2 2 255\nabcdefghijkl").empty();
    if (!is_there) return 0;
    candela::SceneRequest request;
    request.files = {fuzz::written("scene.toml", fuzz::text_of(data, size))};
    request.use_defaults = true;
    candela::Diagnostics diagnostics;
    auto frames = candela::SceneFrames::read(request, test_registry(), diagnostics);
    if (!frames) {
        fuzz::check_diagnostics(diagnostics, false);
        return 0;
    }
    // Checks the first frame, some in between, and the last.
    for (const int frame : std::set{0, frames->count() / 2, frames->count() - 1}) {
        candela::Diagnostics found = diagnostics;
        const candela::SceneDraft draft = frames->draft(frame, found);
        fuzz::check_diagnostics(found, draft.is_complete);
        if (draft.is_complete) fuzz::check_finite(draft.scene);
    }
    return 0;
}
