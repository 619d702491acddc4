// The page shown before a scene has become valid for the first time.
#pragma once

#include <string_view>

namespace view {

/// HTML. Shows the errors, and reloads as the scene's page as soon as that exists.
std::string_view waiting_page();

}  // namespace view
