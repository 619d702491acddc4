#include "candela/plugin/params.h"

#include <array>
#include <cstddef>
#include <string_view>

namespace candela {

namespace {
constexpr std::array<std::string_view, 13> k_type_names = {"real", "integer", "boolean", "choice",    "text",
                                                           "file", "vector",  "point",   "direction", "color",
                                                           "rgb",  "matrix",  "numbers"};
}

std::string_view name_of(ParamType type) noexcept { return k_type_names[static_cast<std::size_t>(type)]; }

}  // namespace candela
