// Pictures that a model names or contains, before a scene relies on them.
#pragma once

#include <string>

#include "import/model.h"

import candela.registry;

namespace importing {

/// What a picture turned out to be.
struct InspectedPicture {
    /// The format that its content tells, where its name says another: "jpg"; otherwise empty.
    std::string other_format;
    /// The mean over the pixels of their largest channel: 0 to 1, linear.
    double brightness = 1;
};

/// Reads a picture as a scene will. Throws candela::Error (failure) with the reason if none can be made of
/// it: no image plugin reads its format, it is empty, it is cut off. Such a scene would be refused.
InspectedPicture inspect(const Picture& picture, candela::Registry& registry);

}  // namespace importing
