// One mistake, one message.
#include "support/broken_scene.h"
#include "console/diagnostics_text.h"

#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/plugins.h"
#include "support/text.h"

TEST_CASE("one randomly broken constraint is reported at its place, and nothing else is") {
    const std::filesystem::path file = scratch_directory() / "scene.toml";
    std::map<std::string, int> found;
    for (unsigned seed = 0; seed < 1000; ++seed) {
        const BrokenScene broken = broken_scene(seed);
        std::filesystem::remove(file);
        write_file(file, broken.text);
        candela::Diagnostics diagnostics;
        candela::SceneRequest request;
        request.files = {file};
        const auto draft = candela::draft_scene(request, test_registry(), diagnostics);
        if (draft) candela::build(*draft, test_registry(), diagnostics);

        INFO("seed " << seed << ", " << broken.rule << "\n"
                     << diagnostics_text(diagnostics, false) << broken.text);
        CHECK(diagnostics.error_count() == 1);
        for (const candela::Diagnostic& d : diagnostics.sorted()) {
            if (d.severity != candela::Severity::error) continue;
            CHECK(holds(d.message, broken.message));
            if (broken.line > 0) CHECK(d.place.line == broken.line);
        }
        ++found[broken.rule];
    }
    CHECK(found.size() >= 30);
    for (const auto& [rule, times] : found) {
        INFO(rule);
        CHECK(times >= 3);
    }
}
