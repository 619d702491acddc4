#include "candela/reflection_model.h"

namespace candela {

Surroundings::~Surroundings() = default;
ReflectionModel::~ReflectionModel() = default;

bool ReflectionModel::reflect_punctual(const SurfaceBatch&, const PunctualLighting&, const Vec3Span&) const {
    return false;
}

void ReflectionModel::show_surroundings(const SurfaceBatch&, Surroundings&, const ReflectedBatch&) const {}

}  // namespace candela
