// Reads the tables of textures.
module;

#include <optional>
#include <string>

module candela.scene:textures;

import :content;
import :tables;
import :toml;
import :validation;
import candela.plugins;
import candela.util;

namespace candela {

/// Reads the table 'transform' of a texture's table, if it has one.
void read_transform(const TableNode& texture, const TableContext& of_texture, Diagnostics& diagnostics,
                    TextureTransform& to);

/// Reads 'normal_map' or 'bump_map' of an object. `where`: the object, for messages. Returns nothing if it
/// has neither, or one that is invalid, which is reported.
std::optional<NormalMap> normal_map_in(const TableNode& object, const std::string& where,
                                       Diagnostics& diagnostics);

}  // namespace candela
