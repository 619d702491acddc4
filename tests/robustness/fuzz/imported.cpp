#include "imported.h"

#include <cstdio>
#include <exception>
#include <optional>
#include <string>

#include "import/import.h"
#include "robustness/fuzz/fuzz.h"
#include "support/plugins.h"

namespace fuzz {

namespace fs = std::filesystem;

namespace {

std::optional<importing::Imported> import(const fs::path& model) {
    try {
        return importing::import_model(
            {.file = model,
             .shown_file = model.string(),
             .write_image = [](const std::string& name,
                               const std::string& content) { return written(name, content).string(); },
             .name_of_image = [](const fs::path& image) { return image.string(); }},
            test_registry());
    } catch (const std::exception& problem) {
        require(*problem.what() != '\0', "a refusal is empty");
        return std::nullopt;
    }
}

}  // namespace

void check_import(const fs::path& model) {
    const auto imported = import(model);
    if (!imported) return;
    for (const std::string& note : imported->notes) require(!note.empty(), "a note is empty");
    candela::SceneRequest request;
    request.files = {written("scene.toml", imported->scene)};
    candela::Diagnostics diagnostics;
    const auto scene = candela::read_scene(request, test_registry(), diagnostics);
    check_diagnostics(diagnostics, scene.has_value());
    if (scene) {
        check_finite(*scene);
        const bool is_compiled = candela::build(*scene, test_registry(), diagnostics).has_value();
        check_diagnostics(diagnostics, is_compiled);
    }
    // (An unreadable picture is a failure; only the file's own text is checked.)
    if (diagnostics.worst() != candela::ErrorCategory::invalid_scene) return;
    for (const candela::Diagnostic& diagnostic : diagnostics.sorted())
        std::fprintf(stderr, "%s\n", diagnostic.message.c_str());
    require(false, "the scene of a model is not valid:\n" + imported->scene);
}

}  // namespace fuzz
