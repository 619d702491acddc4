// Changes of a document's values.
module;

#include <string>
#include <vector>

module candela.scene:setting;

import :document;
import :toml;
import candela.util;

namespace candela {

/// Sets the value at a setting's path, which parts_of() has split. Returns false if the path leads nowhere,
/// which is reported at `place`; `place` also becomes the key's position. `index`: that of `root`, for many
/// calls.
bool set_value(TableNode& root, std::vector<std::string> parts, Node value, const SourceLocation& place,
               Diagnostics& diagnostics, const ElementIndex* index = nullptr);

}  // namespace candela
