#include "candela/light.h"

namespace candela {

Light::~Light() = default;

void Light::illuminate(int, const ReceiverBatch&, const IncidentBatch&) const {}

void Light::illuminate_ambient(const ReceiverBatch&, const Vec3Span&) const {}

}  // namespace candela
