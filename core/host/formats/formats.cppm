module;

#include "candela/api.h"

#include <string>

// What to do about a picture file that no image plugin reads or writes.
export module candela.formats;

import candela.registry;

export namespace candela {

/// " (possible: pnm, png)", and the package that has the other formats if its plugin is not installed. Throws
/// Error like Registry::extensions(). Any thread.
CANDELA_API std::string possible_formats(Registry& registry, FormatUse use);

}  // namespace candela
