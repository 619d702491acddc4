// Punctual lights in double precision.
#pragma once

import candela.api;

/// The light that a source sends to a point: its direction, and the fraction of its intensity
/// (candela/punctual.h).
struct ExactIncident {
    candela::Vec3 to_light;
    double share;
};
ExactIncident incident_of(const candela::PunctualLight& light, candela::Vec3 position);
