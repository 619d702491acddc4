// Light as lamps' data sheets have it: lumens, candelas, lux, watts and colour temperatures.
module;

#include <optional>
#include <string_view>

module candela.scene:photometry;

import candela.api;
import candela.plugins;

namespace candela {

/// The lumens of a radiant watt: the definition of the candela, for light of 540 THz.
inline constexpr double k_lumens_per_watt = 683;

/// A number with a photometric unit: "800 lm", "5 klx".
struct Photometric {
    double value = 0;       // without the prefix of its unit
    std::string_view unit;  // "lm", "cd", "W" or "lx"

    bool is_flux() const { return unit == "lm" || unit == "W"; }
};

/// Nothing if the text is not such a quantity.
std::optional<Photometric> photometric_from(std::string_view text);

/// The `intensity` of a light: luminous intensity, or illuminance, over pi, since models reflect without the
/// 1 / pi of a BRDF. A flux is that of a light that shines equally in all directions.
double intensity_of(const Photometric& quantity);

/// The factor of a flux's intensity in a cone: the full sphere over the cone's solid angle, in which the
/// fading part between the half-angles, in degrees, counts half.
double cone_factor(double inner_angle, double outer_angle);

/// The colour temperatures of blackbody_color(), in kelvin.
inline constexpr float k_lowest_temperature = 1000, k_highest_temperature = 15000;

/// The colour of a black body in linear sRGB, with luminance 1: Krystek (1985), "An algorithm to calculate
/// correlated colour temperature". A channel outside sRGB's gamut, blue below 1900 K, is zero.
Rgb blackbody_color(double kelvin);

}  // namespace candela
