// Numbers of an object's vertices in a glTF primitive: its colours, their alpha, and attributes of its own.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "candela/target.h"
#include "document.h"

namespace candela::gltf_target {

/// The part of an object that its vertices give. glTF multiplies colours and opacities by COLOR_0; no
/// material refers to another attribute, so parameters become attributes by their names, and their means.
class VertexNumbers {
  public:
    /// All arguments outlive it.
    VertexNumbers(const ExportedScene& scene, const ExportedObject& object, const ExportedMesh& mesh,
                  FileSink& files);
    VertexNumbers(const VertexNumbers&) = delete;
    VertexNumbers& operator=(const VertexNumbers&) = delete;

    /// The object without these numbers.
    const ExportedObject& rest() const { return rest_; }
    /// The factor of the vertices' alpha in the material, if they have one.
    const std::optional<float>& alpha() const { return alpha_; }

    void add_to(Json& attributes, Document& document) const;

  private:
    using Numbers = std::vector<ExportedTexturedNumber>;

    void take_colors();
    void take_opacity();
    void take_parameters();
    void take_common();
    /// A number of the material at each vertex. `of`: what it belongs to, if it may be out of range.
    std::vector<float> values_of(const ExportedTexturedNumber& number, const char* of) const;
    /// Makes an attribute of numbers that belong together, and returns their means.
    std::vector<float> named(const std::string& parameter, const Numbers& numbers, float unit);

    const ExportedScene& scene_;
    const ExportedObject& object_;
    const ExportedMesh& mesh_;
    FileSink& files_;
    ExportedObject rest_;
    std::optional<float> alpha_;
    std::vector<float> colors_;  // COLOR_0, if it is not the mesh's own
    std::vector<std::pair<std::string, std::vector<float>>> attributes_;
    Numbers model_numbers_, opacity_numbers_;  // of rest_, like the next two
    std::vector<ExportedValues> materials_;
    std::vector<ParamValue> values_;
};

}  // namespace candela::gltf_target
