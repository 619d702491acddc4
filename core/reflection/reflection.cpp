module candela.reflection;

namespace candela {

ReflectionModel::~ReflectionModel() = default;

}  // namespace candela
