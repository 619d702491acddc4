// Numbers of meshes as text, and in the order in which programs take them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "candela/math.h"

namespace candela::target {

/// x y z of each in turn; none where there are no arrays.
std::vector<float> interleaved(ConstVec3Span arrays, std::size_t count);
/// u v of each in turn; none where there are no arrays.
std::vector<float> interleaved(ConstVec2Span arrays, std::size_t count);

/// "    static const float name[] = {1.5f, ...};", in lines that can be read.
std::string number_array(const char* type, const char* name, std::span<const float> numbers);
std::string number_array(const char* type, const char* name, std::span<const std::uint32_t> numbers);

}  // namespace candela::target
