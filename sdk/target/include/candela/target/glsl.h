// The shaders of a scene, in parts: GLSL 3.30 and GLSL ES 3.00, whichever the header says.
#pragma once

#include <string>
#include <vector>

#include "candela/target.h"

namespace candela::target {

/// An object's vertex shader is: header, "#define TWO_SIDED" if it is open, prelude, lights, its reflection
/// model, its shading model, vertex; the fragment shader likewise. The others are of passes over the whole
/// screen.
struct GlslParts {
    std::string prelude;
    std::string lights;
    std::vector<std::string> reflections, shadings;  // as in the scene
    std::string vertex, fragment;
    std::string screen, accumulate, encode;
};

/// Throws std::runtime_error where the kernels cannot stand in one program.
GlslParts glsl_of(const ExportedScene& scene);

/// The uniforms of a light: "point_lights[2]" and, a bool, "point_lights_on[2]".
struct LightUniform {
    std::string values;
    std::string is_on;
};
/// Of each light of the scene.
std::vector<LightUniform> light_uniforms(const ExportedScene& scene);

/// "face", "vertex", "fragment".
const char* rate_name(ShadingRate rate);

}  // namespace candela::target
