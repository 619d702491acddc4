#include "candela/reflection_model.h"

namespace candela {

Environment::~Environment() = default;
ReflectionModel::~ReflectionModel() = default;

bool ReflectionModel::reflect_all_lights(const SurfaceBatch&, const PunctualLighting&,
                                         const Vec3Span&) const {
    return false;
}

void ReflectionModel::show_environment(const SurfaceBatch&, Environment&, const ReflectedBatch&) const {}

}  // namespace candela
