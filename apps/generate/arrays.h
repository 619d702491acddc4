// Numbers of meshes as text, and in the order in which programs take them.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

import candela.core;

namespace generate {

/// x y z of each in turn.
std::vector<float> interleaved(const candela::Vec3Arrays& arrays);
/// u v of each vertex in turn.
std::vector<float> interleaved_uv(const candela::Mesh& mesh);

/// "    static const float name[] = {1.5f, ...};", in lines that can be read.
std::string number_array(const char* type, const char* name, std::span<const float> numbers);
std::string number_array(const char* type, const char* name, std::span<const std::uint32_t> numbers);

}  // namespace generate
