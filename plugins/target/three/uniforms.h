// The scene's values that kernels read.
#pragma once

#include <cstdint>
#include <vector>

#include "candela/target.h"
#include "json.h"

namespace candela::three_target {

/// The struct of a model's parameters: { member: value }.
Json struct_json(const ExportedModel& model, const ExportedValues& values);

/// The number of lights of each model: { uniform: count }.
Json light_counts(const ExportedScene& scene);

/// The texels of the texture `light_table` (candela/target/glsl.h), one after the other.
std::vector<std::int32_t> light_table(const ExportedScene& scene);

}  // namespace candela::three_target
