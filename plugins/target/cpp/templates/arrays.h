// Helpers for the triangles that stand as numbers at the end of this file.
template <std::size_t n>
std::vector<vec3> vectors_of(const float (&numbers)[n]) {
    std::vector<vec3> result;
    for (std::size_t i = 0; i + 2 < n; i += 3) result.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    return result;
}
