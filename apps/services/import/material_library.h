// Translates the materials of MTL files to a scene's.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "import/images.h"
#include "import/model.h"
#include "import/readers.h"
#include "mesh_io/mtl.h"

import candela.plugins;

namespace importing::obj {

/// The libraries that an OBJ file names.
class MaterialLibraries {
  public:
    /// Notes losses in `model` and adds the materials' pictures to it.
    MaterialLibraries(Model& model, const Source& source, candela::Registry& registry)
        : model_(model), source_(source), registry_(registry) {}

    /// Reads the libraries of an mtllib statement: one whose name may contain blanks, or several.
    void read_named(std::string_view names);

    bool are_there() const { return !known_files_.empty(); }
    bool has(const std::string& name) const { return find(name) != nullptr; }
    Material material(const std::string& name);

  private:
    /// A material before its translation.
    struct Description {
        mesh_io::MtlMaterial material;
        std::filesystem::path folder;  // of its library, which its texture's name is relative to
    };

    /// A picture of the model, and its means.
    struct MeasuredImage {
        std::size_t index = 0;
        Means means{};
    };

    bool read_if_there(std::string_view name);
    void read(const std::filesystem::path& file);
    /// Null if there is none.
    const Description* find(const std::string& name) const;
    static bool is_physical(const mesh_io::MtlMaterial& material);
    /// Uses a material's normal map, or a bump map that is one.
    void tilt_normals(const Description& from, Material& to);
    /// Fills in a material that says how rough or metallic it is.
    void become_metallic_roughness(const Description& from, Material& to);
    /// Makes offset + scale times a channel of a picture the values of a parameter.
    static void add(const mesh_io::MtlMap& map, const MeasuredImage& picture, const char* parameter,
                    double scale, double offset, Material& to);
    void add_emission(const Description& from, Material& to);
    void add_opacity(const Description& from, Material& to);
    std::vector<double> coefficients(const std::vector<double>& value, double otherwise);
    /// The picture of that name.
    std::optional<MeasuredImage> image(const std::string& file, const std::string& material,
                                       const Description& of);

    Model& model_;
    const Source& source_;
    candela::Registry& registry_;
    std::set<std::string, std::less<>> named_;  // by mtllib statements
    std::set<std::filesystem::path> known_files_;
    std::map<std::string, Description, std::less<>> descriptions_;
    std::map<std::string, std::string, std::less<>> commented_;             // names without their comments
    std::map<std::filesystem::path, std::optional<MeasuredImage>> images_;  // by file
};

}  // namespace importing::obj
