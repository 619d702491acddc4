// The values that a picture can show instead of the intensity: the intensity's terms, and its inputs.
module;

#include <cstddef>

export module candela.shading:term;

import candela.api;

export namespace candela {

enum class Term {
    // Found where light is evaluated (at faces, vertices or fragments, depending on the shading model) and
    // carried to the pixels like the intensity. Sums are over the scene's lights.
    intensity,          // I, and the background
    ambient,            // I_a
    diffuse,            // the sum of I_d
    specular,           // the sum of I_s, and what transparent surfaces show of their surroundings
    surroundings,       // only those surroundings
    emission,           // what surfaces emit
    n_dot_l,            // N.L, averaged over the lights' samples; below zero for light from behind
    visibility,         // the fraction of the lights' samples that reach the point; needs shadows
    ambient_occlusion,  // the fraction of ambient light that does, of lights with occlusion rays
    normal,             // N, world space; not unit where it is interpolated between vertices
    color,              // C_o: the object's own, or of its vertices and textures
    parameter,          // a parameter of the reflection model; see ShownParameter

    background,  // where no object is visible; black elsewhere

    // Found at the fragment in the middle of each pixel, so that nothing is averaged.
    depth,        // distance from the observer along the view direction; infinity where there is no object
    position,     // world space
    face_normal,  // world space, unit, of the visible side
    barycentric,  // coordinates on the triangle
    uv,           // texture coordinates; zero on meshes that have none
    opacity,      // the fraction of the background that it covers; 0 where there is no object
    facing,       // 1, or -1 where an open surface is seen from behind; 0 where there is no object
    object,       // index among the scene's, from 0; -1 where there is none
    triangle      // index in the object's mesh; -1 where there is none
};

/// The parameter that Term::parameter shows, of one object. In the unit in which the model receives it.
struct ShownParameter {
    static constexpr std::size_t k_none = static_cast<std::size_t>(-1);

    std::size_t index = k_none;  // among the parameters of its model; k_none: it has no such parameter, 0
    Vec3 value{};                // where no texture gives it; a single number three times
};

/// Whether a term's values at the surfaces that a pixel shows one behind the other add up like the intensity,
/// by what each covers. Of the others, the nearest surface's is shown.
constexpr bool is_additive(Term term) noexcept { return term <= Term::emission || term == Term::background; }

/// Whether a term is found at one fragment per pixel.
constexpr bool is_geometric(Term term) noexcept { return term >= Term::depth; }

}  // namespace candela
