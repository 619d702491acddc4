// The scene that `candela new` writes.
#pragma once

#include <string_view>

/// A valid scene whose comments say what each key does.
std::string_view starter_scene();
