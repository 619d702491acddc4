// Declares a reflection model to be exact, but approximates it.
#include <span>
#include <string_view>

#include "candela/target_plugin.h"

namespace {
class ApproximatesWhatIsExact final : public candela::Target {
  public:
    explicit ApproximatesWhatIsExact(const candela::sdk::NoParams&) {}
    candela::TargetAbilities abilities() const noexcept override { return {.models_without_kernel = true}; }
    const char* main_file() const noexcept override { return "scene.txt"; }
    void write(const candela::ExportedScene& scene, candela::FileSink& files) const override {
        for (const candela::ExportedReflection& model : scene.reflections)
            if (std::string_view(model.plugin->name) == "lambert")
                files.approximate("reflection/lambert becomes reflection/phong");
        files.write(main_file(), std::as_bytes(std::span("a scene", 7)));
    }
};

constexpr candela::Property k_properties[] = {{"exact-reflection", "phong, lambert"}};
}  // namespace

CANDELA_PLUGIN(target, ApproximatesWhatIsExact, candela::sdk::k_no_fields,
               {.title = "Approximates what is exact",
                .summary = "Bad on purpose.",
                .properties = k_properties})
