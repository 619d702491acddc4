#include "mesh_io/ply_colors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh_io/ply_values.h"

namespace mesh_io::ply {

namespace {

float brightest(Type type, float largest) {
    constexpr float k_byte = 255, k_word = 65535;
    if (!is_integer(type)) {
        // Lights may be slightly brighter than white.
        constexpr float k_much_light = 4;
        return largest <= k_much_light ? 1 : largest <= k_byte ? k_byte : largest <= k_word ? k_word : 1;
    }
    if (size_of(type) > 1 && largest <= k_byte) return k_byte;
    if (size_of(type) > 2 && largest <= k_word) return k_word;
    return with_type(type,
                     [](auto t) { return static_cast<float>(std::numeric_limits<decltype(t)>::max()); });
}

}  // namespace

void scale_colors(std::initializer_list<Array<float>*> channels, Type type, std::string_view whose,
                  std::vector<std::string>& notes) {
    float largest = 0;
    for (const Array<float>* const channel : channels)
        for (const float x : *channel)
            if (x > largest && std::isfinite(x)) largest = x;
    const float by = brightest(type, largest);
    if (by == 1) return;
    for (Array<float>* const channel : channels)
        for (float& x : *channel) x /= by;
    const float expected =
        is_integer(type)
            ? with_type(type,
                        [](auto t) { return static_cast<float>(std::numeric_limits<decltype(t)>::max()); })
            : 1;
    if (by != expected && largest > 0)
        notes.push_back(
            fmt::format("has {} colours of type {} up to {:g}, which are interpreted as 0 to {:g}", whose,
                        name_of(type), largest, by));
}

}  // namespace mesh_io::ply
