module;

#include <algorithm>
#include <cstddef>

module candela.shading:clearing;

import candela.api;

namespace candela {

inline void clear(const Vec3Span& vectors, std::size_t count) {
    for (float* const channel : {vectors.x, vectors.y, vectors.z}) std::fill_n(channel, count, 0.0f);
}

}  // namespace candela
