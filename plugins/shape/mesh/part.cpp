#include "part.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numeric>
#include <string>

#include "mesh_io/text_scanner.h"

namespace mesh {

namespace {

constexpr std::uint32_t k_unused = 0xffff'ffffu;

/// The materials that a name refers to.
std::vector<bool> chosen_of(const mesh_io::Surface& surface, std::string_view part) {
    std::vector<bool> chosen(surface.materials.size());
    for (std::size_t i = 0; i < chosen.size(); ++i) chosen[i] = surface.materials[i] == part;
    // The scene may say "red" where the file says "usemtl red # a comment".
    if (std::ranges::find(chosen, true) == chosen.end())
        for (std::size_t i = 0; i < chosen.size(); ++i)
            chosen[i] = surface.materials[i].starts_with(std::string(part) + " #");
    if (std::ranges::find(chosen, true) != chosen.end() || !part.starts_with('#')) return chosen;
    std::size_t number = 0;
    const auto [end, problem] = std::from_chars(part.data() + 1, part.data() + part.size(), number);
    if (problem == std::errc() && end == part.data() + part.size() && number < chosen.size())
        chosen[number] = true;
    return chosen;
}

[[noreturn]] void refuse(const mesh_io::Surface& surface, std::string_view part) {
    if (surface.materials.empty())
        throw mesh_io::BadFile(fmt::format("has no materials, and so no part {}", mesh_io::in_quotes(part)));
    std::vector<std::string> names;
    constexpr std::size_t k_most_named = 8;
    for (const std::string& name : surface.materials)
        if (names.size() < k_most_named && !name.empty()) names.push_back(mesh_io::in_quotes(name));
    throw mesh_io::BadFile(fmt::format("has no triangles with a material {}{}", mesh_io::in_quotes(part),
                                       names.empty() ? "" : "; its materials: " + mesh_io::listed(names)));
}

template <class Values>
Values picked(const Values& values, std::span<const std::uint32_t> which) {
    Values result;
    if (values.empty()) return result;
    result.resize(which.size());
    for (std::size_t i = 0; i < which.size(); ++i) result[i] = values[which[i]];
    return result;
}

mesh_io::Vectors picked(const mesh_io::Vectors& values, std::span<const std::uint32_t> which) {
    return {picked(values.x, which), picked(values.y, which), picked(values.z, which)};
}

/// The distinct values of `indices` in ascending order; `indices` become positions among them.
std::vector<std::uint32_t> renumbered(mesh_io::Array<std::uint32_t>& indices) {
    const auto [low, high] = std::ranges::minmax(indices);
    const std::size_t range = std::size_t{high} - low + 1;
    std::vector<std::uint32_t> values;
    constexpr std::size_t k_sparse = 16;
    if (range / k_sparse > indices.size()) {
        values.assign(indices.begin(), indices.end());
        std::ranges::sort(values);
        values.erase(std::ranges::unique(values).begin(), values.end());
        for (std::uint32_t& index : indices)
            index = static_cast<std::uint32_t>(std::ranges::lower_bound(values, index) - values.begin());
        return values;
    }
    std::vector<std::uint32_t> number(range, k_unused);
    for (const std::uint32_t index : indices) number[index - low] = 0;
    for (std::size_t i = 0; i < range; ++i) {
        if (number[i] == k_unused) continue;
        number[i] = static_cast<std::uint32_t>(values.size());
        values.push_back(low + static_cast<std::uint32_t>(i));
    }
    for (std::uint32_t& index : indices) index = number[index - low];
    return values;
}

}  // namespace

TrianglesByMaterial::TrianglesByMaterial(const mesh_io::Surface& surface)
    : begin_(surface.materials.size() + 1), triangles_(surface.material.size()) {
    for (const std::uint32_t material : surface.material) ++begin_[material + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t t = 0; t < surface.material.size(); ++t) triangles_[next[surface.material[t]]++] = t;
}

mesh_io::Surface part_of(const mesh_io::Surface& surface, const TrianglesByMaterial& triangles,
                         std::string_view part) {
    const std::vector<bool> chosen = chosen_of(surface, part);
    std::vector<std::uint32_t> kept;
    for (std::size_t material = 0; material < chosen.size(); ++material) {
        if (!chosen[material]) continue;
        const auto more = triangles.of(material);
        kept.insert(kept.end(), more.begin(), more.end());
    }
    if (kept.empty()) refuse(surface, part);
    std::ranges::sort(kept);  // several materials may share a name

    mesh_io::Surface result;
    result.indices.resize(3 * kept.size());
    for (std::size_t i = 0; i < kept.size(); ++i)
        std::copy_n(&surface.indices[3 * std::size_t{kept[i]}], 3, &result.indices[3 * i]);
    const std::vector<std::uint32_t> vertices = renumbered(result.indices);
    result.position = picked(surface.position, vertices);
    result.normal = picked(surface.normal, vertices);
    result.tangent = picked(surface.tangent, vertices);
    result.tangent_side = picked(surface.tangent_side, vertices);
    result.color = picked(surface.color, vertices);
    for (const mesh_io::Attribute& attribute : surface.attributes) {
        mesh_io::Attribute& to = result.attributes.emplace_back(attribute.name);
        for (const mesh_io::Array<float>& channel : attribute.channels)
            to.channels.push_back(picked(channel, vertices));
    }
    result.u = picked(surface.u, vertices);
    result.v = picked(surface.v, vertices);
    result.facet_normal = picked(surface.facet_normal, kept);
    result.smoothing = picked(surface.smoothing, kept);
    result.is_color_linear = surface.is_color_linear;
    result.losses = surface.losses;
    result.notes = surface.notes;
    return result;
}

}  // namespace mesh
