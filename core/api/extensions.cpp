#include "candela/extensions.h"

namespace candela {

PunctualSource::~PunctualSource() = default;
UniformAmbientSource::~UniformAmbientSource() = default;
AllLightsReflection::~AllLightsReflection() = default;
Environment::~Environment() = default;
EnvironmentReflection::~EnvironmentReflection() = default;

}  // namespace candela
