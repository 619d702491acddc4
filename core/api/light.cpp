#include "candela/light.h"

namespace candela {

Light::~Light() = default;

void Light::illuminate(int, const ReceiverBatch&, const IncidentBatch&) const {}

void Light::illuminate_ambient(const ReceiverBatch&, const Vec3Span&) const {}

bool Light::as_punctual(int, PunctualLight&) const { return false; }

bool Light::as_ambient(Rgb&) const { return false; }

}  // namespace candela
