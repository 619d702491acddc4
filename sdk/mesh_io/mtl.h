// The materials of an MTL file.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mesh_io {

/// A picture of numbers, or of a colour.
struct MtlMap {
    std::string file;       // as the library names it; empty: none
    bool clamps = false;    // at its edges
    char channel = 'r';     // of numbers: r, g or b
    double multiplier = 1;  // -bm, of a bump map
    // -s and -o: texture coordinates are scaled, then moved.
    std::array<double, 2> scale{1, 1}, offset{0, 0};
};

/// A material in the terms of the file.
struct MtlMaterial {
    std::string name;                // with a possible comment
    std::vector<double> ka, kd, ks;  // three numbers; empty if absent
    std::vector<double> ke;          // the same
    MtlMap emission_map{};           // map_Ke
    double opacity = 1;              // d, or 1 - Tr
    MtlMap opacity_map{};            // map_d
    double shininess = 0;            // Ns
    int illumination = 2;            // illum
    MtlMap color_map{};              // map_Kd
    // Of materials for physically based models, absent for others:
    std::optional<double> roughness{}, metallic{}, sheen{};  // Pr, Pm, Ps
    std::optional<double> coat{}, coat_roughness{};          // Pc, Pcr
    std::optional<double> anisotropy{}, rotation{};          // aniso; anisor, in turns
    MtlMap roughness_map{}, metallic_map{};                  // map_Pr, map_Pm
    MtlMap normal_map{}, bump_map{};                         // norm; map_bump or bump
};

struct MaterialLibrary {
    std::vector<MtlMaterial> materials;  // each once, with its last description
    std::vector<std::string> notes;      // what is left out: whole sentences without a full stop
};

/// Never refuses a statement; leaves it out. Throws BadFile for UTF-16.
MaterialLibrary read_mtl(std::string_view text);

}  // namespace mesh_io
