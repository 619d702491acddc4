// What a picture can show instead of the intensity: the intensity's terms, and what it was computed from.
export module candela.shade:term;

export namespace candela {

enum class Term {
    // Found where light is evaluated (at faces, vertices or fragments, as the shading model has it) and
    // carried to the pixels like the intensity. What is summed over lights is summed over the scene's.
    intensity,     // I, and the background
    ambient,       // I_a
    diffuse,       // the sum of I_d
    specular,      // the sum of I_s, and what transparent surfaces show of their surroundings
    surroundings,  // that alone
    n_dot_l,       // N.L, the mean over the lights' samples; below zero for light from behind
    normal,        // N, world space; not unit where it is interpolated between vertices

    background,  // where no object is seen; black elsewhere

    // Found at the fragment in the middle of each pixel, so that nothing is averaged.
    depth,     // the distance from the observer along the view direction; infinity where there is no object
    position,  // world space
    face_normal,  // world space, unit, of the side that is seen
    barycentric,  // coordinates on the triangle
    uv,           // texture coordinates; zero on meshes that have none
    facing,       // 1, or -1 where an open surface is seen from behind; 0 where there is no object
    object,       // its index among the scene's, from 0; -1 where there is none
    triangle      // its index in the object's mesh, likewise
};

/// Whether a term is found at one fragment a pixel.
constexpr bool is_geometric(Term term) noexcept { return term >= Term::depth; }

}  // namespace candela
