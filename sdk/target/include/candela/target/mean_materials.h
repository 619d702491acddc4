// Materials with textures or numbers of vertices, for renderers that have only numbers in their place.
#pragma once

#include <cstddef>
#include <vector>

#include "candela/target.h"

namespace candela::target {

/// The mean of a number that a picture gives.
float mean_of(const ExportedScene& scene, const ExportedTexturedNumber& number);

/// The values of an object's own reflection model as an instance receives them, with the means of those that
/// pictures give.
std::vector<ParamValue> mean_values(const ExportedScene& scene, const ExportedObject& object);

/// Reports that the picture of a parameter, index in the object's own reflection model, becomes its mean.
void approximate_by_mean(const ExportedScene& scene, const ExportedObject& object, std::size_t parameter,
                         FileSink& files);

/// A scene whose materials have the means of their pictures and of their vertices; colours and opacities
/// stay.
class MeanMaterials {
  public:
    /// Refers to `scene`. Reports each parameter that becomes a mean.
    MeanMaterials(const ExportedScene& scene, FileSink& files);
    MeanMaterials(const MeanMaterials&) = delete;
    MeanMaterials& operator=(const MeanMaterials&) = delete;

    const ExportedScene& scene() const noexcept { return scene_; }

  private:
    /// Of emission and occlusion.
    void take_common(ExportedObject& object, std::size_t index, FileSink& files) const;
    /// Of a number of an object, from its picture or its vertices.
    float mean(const ExportedTexturedNumber& number, std::size_t object) const;

    ExportedScene scene_;
    std::vector<ExportedObject> objects_;
    std::vector<std::vector<ExportedValues>> materials_;
    std::vector<std::vector<ParamValue>> values_;
};

}  // namespace candela::target
