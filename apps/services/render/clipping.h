// Notices pictures that show much light as plain white, or as one full channel.
#pragma once

#include <string>

import candela.render;

namespace candela {

/// A sentence with the share of the pixels that are clipped, if it is large; otherwise empty, as for pictures
/// of floats and tone curves, which clip nothing. The background's own colour does not count.
std::string clipping_diagnosis(const RenderScene& scene, const Film& film,
                               const RenderStatistics& statistics);

}  // namespace candela
