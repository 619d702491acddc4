#include "incident.h"

#include <algorithm>
#include <array>
#include <cmath>

ExactIncident incident_of(const candela::PunctualLight& light, candela::Vec3 position) {
    const std::array<double, 3> d{double{light.position.x} - double{light.w} * double{position.x},
                                  double{light.position.y} - double{light.w} * double{position.y},
                                  double{light.position.z} - double{light.w} * double{position.z}};
    const double distance = std::hypot(d[0], d[1], d[2]);
    const double r = std::max(distance, 1e-4);
    ExactIncident incident{
        {static_cast<float>(d[0] / distance), static_cast<float>(d[1] / distance),
         static_cast<float>(d[2] / distance)},
        1 / (double{light.constant} + double{light.linear} * r + double{light.quadratic} * r * r)};
    if (!light.has_cone) return incident;
    const double cosine =
        -(d[0] * double{light.axis.x} + d[1] * double{light.axis.y} + d[2] * double{light.axis.z}) / distance;
    const double t = std::clamp((cosine - double{light.cos_outer}) * double{light.cone_scale}, 0.0, 1.0);
    incident.share *= light.is_smooth ? t * t * (3 - 2 * t) : t;
    return incident;
}
