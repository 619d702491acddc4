// Lobes as files.
#pragma once

#include <string>
#include <vector>

#include "plot/lobe.h"

/// A table: the angle, and each lobe's diffuse part, specular part and sum.
std::string lobes_csv(const std::vector<Lobe>& lobes);

enum class RadialScale { linear, logarithmic };

/// A polar diagram: the light arrives from the left, `incidence` degrees from the normal.
std::string lobes_svg(const std::vector<Lobe>& lobes, double incidence, RadialScale scale);
