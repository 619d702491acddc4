#include "part.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string>

#include "text_scanner.h"

namespace mesh {

namespace {

constexpr std::uint32_t k_unused = 0xffff'ffffu;

/// Which of the materials are meant.
std::vector<bool> chosen_of(const Surface& surface, std::string_view part) {
    std::vector<bool> chosen(surface.materials.size());
    for (std::size_t i = 0; i < chosen.size(); ++i) chosen[i] = surface.materials[i] == part;
    if (std::ranges::find(chosen, true) != chosen.end() || !part.starts_with('#')) return chosen;
    std::size_t number = 0;
    const auto [end, problem] = std::from_chars(part.data() + 1, part.data() + part.size(), number);
    if (problem == std::errc() && end == part.data() + part.size() && number < chosen.size())
        chosen[number] = true;
    return chosen;
}

[[noreturn]] void refuse(const Surface& surface, std::string_view part) {
    if (surface.materials.empty())
        throw BadFile(fmt::format("has no materials, and so no part {}", in_quotes(part)));
    std::vector<std::string> names;
    constexpr std::size_t k_most_named = 8;
    for (const std::string& name : surface.materials)
        if (names.size() < k_most_named && !name.empty()) names.push_back(in_quotes(name));
    throw BadFile(fmt::format("has no triangles with a material {}{}", in_quotes(part),
                              names.empty() ? "" : "; its materials: " + listed(names)));
}

/// Moves the kept elements, whose numbers rise, to the front.
template <class Values>
void keep_used(const std::vector<std::uint32_t>& kept, Values& values) {
    if (values.empty()) return;
    for (std::size_t i = 0; i < kept.size(); ++i) values[i] = values[kept[i]];
    values.resize(kept.size());
}

void keep_used(const std::vector<std::uint32_t>& kept, Vectors& values) {
    for (Array<float>* const channel : {&values.x, &values.y, &values.z}) keep_used(kept, *channel);
}

}  // namespace

void keep_part(Surface& surface, std::string_view part) {
    const std::vector<bool> chosen = chosen_of(surface, part);
    std::vector<std::uint32_t> kept_triangles;
    for (std::uint32_t t = 0; t < surface.material.size(); ++t)
        if (chosen[surface.material[t]]) kept_triangles.push_back(t);
    if (kept_triangles.empty()) refuse(surface, part);

    // In their order, so that each moves only forwards.
    std::vector<std::uint32_t> number(surface.position.size(), k_unused);
    for (std::size_t i = 0; i < kept_triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = surface.indices[3 * std::size_t{kept_triangles[i]} + k];
            surface.indices[3 * i + k] = vertex;
            number[vertex] = 0;
        }
    surface.indices.resize(3 * kept_triangles.size());
    std::vector<std::uint32_t> kept_vertices;
    for (std::uint32_t v = 0; v < number.size(); ++v) {
        if (number[v] == k_unused) continue;
        number[v] = static_cast<std::uint32_t>(kept_vertices.size());
        kept_vertices.push_back(v);
    }
    for (std::uint32_t& index : surface.indices) index = number[index];
    keep_used(kept_vertices, surface.position);
    keep_used(kept_vertices, surface.normal);
    keep_used(kept_vertices, surface.color);
    keep_used(kept_vertices, surface.u);
    keep_used(kept_vertices, surface.v);
    keep_used(kept_triangles, surface.facet_normal);
    keep_used(kept_triangles, surface.smoothing);
    surface.material.clear();
}

}  // namespace mesh
