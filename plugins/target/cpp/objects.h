// Names and objects of a generated C++ program.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "candela/target.h"
#include "grid_shape.h"

namespace candela::cpp_target {

/// The members of an object that hold a model's parameters.
std::string material_member(const ExportedModel& model);
std::string shading_member(const ExportedModel& model);
/// The enumerators for models to choose from.
std::string reflection_enumerator(const ExportedModel& model);
std::string shading_enumerator(const ExportedModel& model);
std::vector<std::string> reflection_enumerators(const ExportedScene& scene);
std::vector<std::string> shading_enumerators(const ExportedScene& scene);

/// Three numbers, separated by commas.
std::string list(float x, float y, float z);

/// The objects of a scene as statements, and the triangles of their shapes.
class CppObjects {
  public:
    /// Throws std::runtime_error if a shading model makes vertex normals that its kernel does not describe.
    explicit CppObjects(const ExportedScene& scene);

    /// Statements that append each object to a vector `all`.
    const std::string& statements() const { return statements_; }
    /// The statements of material_at() for objects whose material has textures; empty if there are none.
    const std::string& textured_materials() const { return textured_materials_; }
    /// The statements of opacity_at() for objects whose opacity a texture gives.
    const std::string& textured_opacities() const { return textured_opacities_; }
    /// Declarations needed before that: functions that make triangles.
    std::string shapes() const;
    /// The end of the program: functions with triangles as numbers; empty if there are none.
    const std::string& data() const { return data_; }
    /// Whether a mesh has colours at its vertices.
    bool has_vertex_colors() const { return has_vertex_colors_; }
    /// The shapes whose triangles the program makes with their kernels.
    const std::vector<ExportedModel>& shape_models() const { return shape_models_; }

  private:
    void add_object(std::size_t index);
    static std::string grid_text(const ExportedObject& object, const GridShape& grid, bool needs_derivatives);
    std::size_t mesh_number(const ExportedMesh& mesh);
    static std::string texel_text(const ExportedTexturedNumber& number, const std::string& at);
    std::string textured_material(std::size_t number, const ExportedObject& object) const;
    void require_default_normals(std::size_t object) const;

    const ExportedScene& scene_;
    std::vector<ExportedModel> shape_models_;
    std::vector<std::string> meshes_;
    std::string statements_, data_, textured_materials_, textured_opacities_;
    std::size_t textured_count_ = 0, textured_opacity_count_ = 0;
    bool has_vertex_colors_ = false;
};

}  // namespace candela::cpp_target
