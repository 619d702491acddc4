#include "compiled.h"

#include <catch2/catch_test_macros.hpp>
#include <utility>

#include "command.h"
#include "console/diagnostics_text.h"
#include "plugins.h"

Compiled compiled(const candela::SceneRequest& request) {
    candela::Diagnostics diagnostics;
    auto source = candela::read_scene(request, test_registry(), diagnostics);
    INFO(diagnostics_text(diagnostics, false));
    REQUIRE(source.has_value());
    auto scene = candela::build(*source, test_registry(), diagnostics);
    REQUIRE(scene.has_value());
    return {std::move(*source), std::move(*scene)};
}

Compiled compiled(const std::string& text, const std::vector<candela::Setting>& settings) {
    candela::SceneRequest request;
    request.files = {write_file(scratch_directory() / "scene.toml", text)};
    request.settings = settings;
    return compiled(request);
}
