// Values as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "candela/target/literals.h"

namespace candela::three_target {

using Json = nlohmann::json;
using target::shortest;

inline Json vector_json(Vec3 v) { return {shortest(v.x), shortest(v.y), shortest(v.z)}; }

}  // namespace candela::three_target
