// Numbers written in other ways than as numbers: with a unit, or as a camera's settings.
module;

#include <optional>

module candela.scene:notations;

import :toml;
import candela.plugins;
import candela.util;

namespace candela {

/// Whether the parameter's value may be written as this node, which is not a number.
bool is_notation(const Node& node, const Parameter& parameter);

/// The number that is_notation() means, before its range is checked. Reports what is wrong with it.
std::optional<double> noted_number(const Node& node, const Parameter& parameter, Diagnostics& diagnostics);

}  // namespace candela
