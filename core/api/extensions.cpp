#include "candela/extensions.h"

namespace candela {

PunctualSource::~PunctualSource() = default;
UniformAmbientSource::~UniformAmbientSource() = default;
SkySource::~SkySource() = default;
GlossyReflection::~GlossyReflection() = default;
AllLightsReflection::~AllLightsReflection() = default;
Environment::~Environment() = default;
EnvironmentReflection::~EnvironmentReflection() = default;
Rgb EnvironmentReflection::transmittance(const Rgb&, float) const { return {0, 0, 0}; }

}  // namespace candela
