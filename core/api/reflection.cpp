#include "candela/reflection.h"

namespace candela {

Surroundings::~Surroundings() = default;
ReflectionModel::~ReflectionModel() = default;

void ReflectionModel::show_surroundings(const SurfaceBatch&, Surroundings&, const ReflectedBatch&) const {}

}  // namespace candela
