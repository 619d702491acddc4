// Arbitrary bytes as a plugin's manifest.
#include <cmath>
#include <stdexcept>

#include "robustness/fuzz/fuzz.h"

namespace {

/// Uses a manifest like listings and scenes do before the plugin's library is loaded.
void use(const candela::Manifest& manifest) {
    for (const candela::Parameter& parameter : manifest.parameters) {
        static_cast<void>(candela::constraint_text(parameter));
        if (!parameter.default_value) continue;
        static_cast<void>(candela::text_of(*parameter.default_value));
        static_cast<void>(candela::validation_error(parameter, *parameter.default_value));
    }
    const candela::ParamSet values(manifest.parameters);
    for (const candela::Relation& relation : manifest.relations) {
        static_cast<void>(candela::validation_error(relation, values));
    }
    try {
        const auto delivered = values.runtime(candela::ColorEncoding::srgb);
        for (std::size_t i = 0; i < delivered.size(); ++i) {
            for (const float number : delivered[i].number)
                fuzz::require(std::isfinite(number), "a default is not finite");
            if (values.schema()[i].type != candela::ParamType::choice) continue;
            fuzz::require(static_cast<std::size_t>(delivered[i].integer) < values.schema()[i].choices.size(),
                          "a default is not a choice");
        }
    } catch (const std::invalid_argument&) {  // a required parameter
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const candela::Manifest manifest = candela::manifest_from_json(fuzz::text_of(data, size));
        fuzz::require(candela::manifest_from_json(candela::to_json(manifest)) == manifest,
                      "a manifest changes when it is written and read");
        use(manifest);
    } catch (const candela::Error& problem) {
        fuzz::require(!std::string_view(problem.what()).empty(), "a refusal is empty");
    }
    return 0;
}
