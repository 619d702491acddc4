// Arbitrary bytes as --set PATH=VALUE of the default scene, one per line.
#include "robustness/fuzz/fuzz.h"
#include "support/plugins.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    candela::SceneRequest request;
    std::string_view rest = fuzz::text_of(data, size);
    while (!rest.empty()) {
        const std::string line(rest.substr(0, rest.find('\n')));
        rest.remove_prefix(std::min(line.size() + 1, rest.size()));
        const std::size_t equals = line.find('=');
        if (equals == std::string::npos) continue;
        const std::string path = line.substr(0, equals);
        request.settings.push_back({"--set " + path, path, line.substr(equals + 1)});
    }
    candela::Diagnostics diagnostics;
    const auto scene = candela::read_scene(request, test_registry(), diagnostics);
    fuzz::check_diagnostics(diagnostics, scene.has_value());
    if (scene) fuzz::check_finite(*scene);
    return 0;
}
