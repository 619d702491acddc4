#include "mesh_io/obj_statements.h"

#include <vector>

#include "mesh_io/surface.h"

namespace mesh_io {

std::string material_name(std::string_view rest) {
    std::string name;
    TextScanner words(rest);
    for (std::string_view word = words.word(); !word.empty(); word = words.word())
        name.append(name.empty() ? "" : " ").append(word);
    return name;
}

std::uint32_t MaterialNumbers::of(const std::string& name) {
    const auto [known, is_new] = numbers_.try_emplace(name, static_cast<std::uint32_t>(names_.size()));
    if (is_new) names_.push_back(name);
    return known->second;
}

ObjMaterials materials_of_obj(std::string_view text) {
    ObjMaterials result;
    std::vector<bool> is_used;  // by number
    std::string current = k_no_material;
    bool is_listed = false;  // the current material is among the used ones
    each_statement(text, [&](const Statement& s) {
        if (s.keyword == "mtllib") {
            result.libraries.emplace_back(s.rest);
        } else if (s.keyword == "usemtl") {
            current = material_name(s.rest);
            if (current.empty()) current = k_no_material;
            const std::uint32_t number = result.numbers.of(current);
            is_listed = number < is_used.size() && is_used[number];
        } else if (!is_listed && (s.keyword == "f" || s.keyword == "fo")) {
            const std::uint32_t number = result.numbers.of(current);
            is_used.resize(result.numbers.names().size());
            is_used[number] = true;
            result.used.push_back(current);
            is_listed = true;
        }
    });
    return result;
}

}  // namespace mesh_io
