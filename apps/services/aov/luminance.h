// Pictures of luminance in false colours, with a legend.
#pragma once

#include <optional>
#include <string>

import candela.api;
import candela.render;

/// The luminances in cd/m² that have the first and the last colour; between them, colours are logarithmic.
struct LuminanceScale {
    double low = 1, high = 10;
};

/// The scale for "LOW,HIGH". Throws candela::Error (bad_request); `origin` names the text's source.
LuminanceScale luminance_scale_from(const std::string& text, const std::string& origin);

/// Powers of ten around the luminances, at most four decades below the largest.
LuminanceScale scale_for(const candela::Film& luminance);

/// The colour at `t` from 0, the scale's low end, to 1, as encoded in a picture.
candela::Rgb false_color(double t);

/// An 8-bit picture of luminances, which the first channel of `luminance` holds. Pixels without light are
/// black.
candela::Film in_false_colors(const candela::Film& luminance, const LuminanceScale& scale);

/// The picture with a legend to its right.
candela::Film with_legend(const candela::Film& picture, const LuminanceScale& scale);

/// How luminances are shown in 8-bit pictures.
struct LuminanceDisplay {
    std::optional<LuminanceScale> scale{};  // if empty, the first picture's, which others then share
    bool has_legend = true;
};
