// Keys as other programs call them, or in the wrong table.
module;

#include <functional>
#include <string>
#include <string_view>

module candela.scene:vocabulary;

import candela.plugins;

namespace candela {

/// For TableContext::hint: returns what an unknown key is called here ("did you mean 'position'?"), or where
/// it belongs. `table`: a name in scene_schema(); empty for the top of the file; "material" for an object's
/// material.
std::function<std::string(const std::string& key)> hints_for(std::string_view table, Registry& registry);

}  // namespace candela
