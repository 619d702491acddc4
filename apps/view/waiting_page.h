// What a browser shows of a scene that has not been right yet.
#pragma once

#include <string_view>

namespace view {

/// HTML. It shows what is wrong and becomes the scene's page as soon as there is one.
std::string_view waiting_page();

}  // namespace view
