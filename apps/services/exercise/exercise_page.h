// The page of an exercise: a kernel with a blank, and the model's results.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace exercise {

/// A value of the kernel's struct, for a shader.
struct Uniform {
    std::string name;  // "material.kd"
    std::string kind;  // "int", "float", "vec3", "mat3"
    std::vector<float> value;
};

/// One light and one set of material values, and the model's result at each point: three numbers per point
/// and term.
struct Case {
    std::string label;
    std::array<float, 3> to_light{};  // L
    std::vector<Uniform> material;
    std::vector<float> ambient, diffuse, specular;
};

/// Everything that a page contains. It is in the page's text, so it must not include the formula.
struct Content {
    std::string model;                    // "reflection/phong"
    std::string function;                 // "phong_reflect"
    std::string title;                    // of the model
    std::string reference;                // its paper; may be empty
    std::string before, after;            // the kernel around the blank, for the reader
    std::string glsl_before, glsl_after;  // the shader around the blank
    std::size_t size = 0;                 // the picture's, in pixels
    std::span<const std::size_t> pixels;  // the pixels on the ball, row by row from the top
    std::span<const float> normals;       // N, three per point; V is (0, 0, 1), and the position is N
    std::span<const float> tangents;      // three per point
    std::array<float, 3> color{};         // C_o
    std::vector<Case> cases;
};

/// The page: HTML that needs no other file.
std::string page_of(const Content& content);

}  // namespace exercise
