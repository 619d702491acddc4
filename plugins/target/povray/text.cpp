#include "text.h"

#include <fmt/format.h>

namespace candela::povray_target {

std::string vector_text(Vec3 v) { return fmt::format("<{}, {}, {}>", v.x, v.y, v.z); }

std::string vector_text(const target::Vector& v) {
    return fmt::format("<{:.9g}, {:.9g}, {:.9g}>", v[0], v[1], v[2]);
}

std::string rgb_text(Vec3 color) {
    return is_grey(color) ? fmt::format("rgb {}", color.x) : "rgb " + vector_text(color);
}

}  // namespace candela::povray_target
