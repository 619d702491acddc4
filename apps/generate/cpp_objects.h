// Names, values and objects of a generated C++ program.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "exported_scene.h"
#include "grid_shape.h"
#include "text_template.h"

import candela.core;

namespace generate {

/// A plugin's name as an identifier of C++.
std::string identifier(const std::string& name);
/// The members of an object that hold a model's parameters.
std::string material_member(const ExportedModel& model);
std::string shading_member(const ExportedModel& model);

/// Three numbers, parted by commas.
std::string list(float x, float y, float z);
/// A kernel's struct with these values: "PhongMaterial{vec3(0.1f), ...}", its members in their order.
std::string struct_text(const KernelSource& kernel, const candela::ParamSet& values,
                        candela::ColorEncoding encoding);

/// The objects of a scene as statements, and the triangles of their shapes.
class CppObjects {
  public:
    /// Throws candela::Error where a shading model makes vertex normals of which its kernel says nothing.
    CppObjects(const ExportedScene& scene, const Templates& templates, candela::Registry& registry);

    /// Puts each into a vector `all`.
    const std::string& statements() const { return statements_; }
    /// What has to stand before that: functions that make triangles.
    std::string shapes() const;
    /// What stands at the end of the program: triangles as numbers, in functions; empty where there are none.
    const std::string& data() const { return data_; }
    /// The shapes whose kernels the program makes triangles with.
    const std::vector<const ExportedModel*>& shape_models() const { return shape_models_; }

  private:
    void add_object(std::size_t index);
    std::string grid_text(const ExportedObject& object, const GridShape& grid, bool needs_derivatives) const;
    std::size_t mesh_number(const candela::PlacedShape& shape);
    void require_plain_normals(const ExportedObject& object);

    const ExportedScene& scene_;
    const Templates& templates_;
    candela::Registry& registry_;
    candela::ColorEncoding encoding_;
    std::vector<const ExportedModel*> shape_models_;
    std::vector<std::string> meshes_;
    std::string statements_, data_;
};

}  // namespace generate
