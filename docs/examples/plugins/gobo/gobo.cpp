#include <candela/light_plugin.h>

namespace candela::kernel {
#include "gobo.kernel"
}

using candela::kernel::GoboLight;
using namespace candela::sdk;

constexpr auto k_fields = fields(
    light_color(&GoboLight::color), light_intensity(&GoboLight::intensity, "intensity at one metre"),
    point(&GoboLight::position, "position", "the lamp's position"),
    direction(&GoboLight::direction, "direction", "the direction in which the light travels"),
    angle(&GoboLight::angle, "angle", 50, "the width of the square field, from edge to edge").range(1, 170),
    integer(&GoboLight::panes, "panes", 3, "the window's panes, across and down").range(1, 8),
    real(&GoboLight::bars, "bars", 0.2f, "the share of a pane covered by bars").range(0.02f, 0.9f),
    real(&GoboLight::softness, "softness", 0.02f, "the softness of the edges, as a share of a pane")
        .range(0.01f, 0.2f),
    real(&GoboLight::leak, "leak", 0.02f, "the share of light that passes the bars").range(0.01f, 1));

constexpr candela::Property k_properties[] = {{"attenuation", "by distance"}};

CANDELA_LIGHT_PLUGIN(
    gobo, GoboLight, k_fields,
    {.title = "Gobo",
     .summary = "A projector that casts the pattern of a barred window.",
     .formula = "L = (position - p) / r\nI_L = color intensity / r^2 (k + (1 - k) window(x) window(y))\n"
                "(x, y) = -L in the plate's plane, over tan(angle / 2)",
     .properties = k_properties})
