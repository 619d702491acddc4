#include "candela/reflection_model.h"

namespace candela {

ReflectionModel::~ReflectionModel() = default;

}  // namespace candela
