// Converts numbers of meshes to text, and to the order in which programs need them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "candela/math.h"

namespace candela::target {

/// x y z of each element; empty if the arrays are absent.
std::vector<float> interleaved(ConstVec3Span arrays, std::size_t count);
/// u v of each element; empty if the arrays are absent.
std::vector<float> interleaved(ConstVec2Span arrays, std::size_t count);

/// "    static const float name[] = {1.5f, ...};", in readable lines.
std::string number_array(const char* type, const char* name, std::span<const float> numbers);
std::string number_array(const char* type, const char* name, std::span<const std::uint32_t> numbers);
std::string number_array(const char* type, const char* name, std::span<const std::int32_t> numbers);

}  // namespace candela::target
