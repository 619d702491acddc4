#include <candela/light_plugin.h>

namespace candela::kernel {
#include "sun.kernel"
}

using candela::kernel::SunLight;
using namespace candela::sdk;

constexpr auto k_fields =
    fields(light_color(&SunLight::color),
           light_intensity(&SunLight::intensity, "intensity by day, the same everywhere"),
           integer(&SunLight::year, "year", 2024, "the year of the date").range(1950, 2050),
           integer(&SunLight::month, "month", 6, "the month of the date").range(1, 12),
           integer(&SunLight::day, "day", 21, "the day of the month").range(1, 31),
           real(&SunLight::hour, "hour", 12, "the time of day, in UTC").range(0, 24).unit("h"),
           angle(&SunLight::latitude, "latitude", 48, "positive north of the equator").range(-90, 90),
           angle(&SunLight::longitude, "longitude", 11, "positive east of Greenwich").range(-180, 180));

constexpr candela::Property k_properties[] = {{"attenuation", "constant"}};

CANDELA_LIGHT_PLUGIN(
    sun, SunLight, k_fields,
    {.title = "Sun by date and place",
     .summary = "The sun at a given time and place; east is +x, north is -z. At night it is dark.",
     .formula = "L from the sun's declination and hour angle (Michalsky 1988)\nI_L = color intensity",
     .reference = "Michalsky (1988), The Astronomical Almanac's algorithm for approximate solar position, "
                  "Solar Energy 40(3), 227-235",
     .properties = k_properties})
