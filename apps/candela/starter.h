// The scene that `candela new` writes.
#pragma once

#include <string>

enum class Starter { picture, film };

/// A valid scene whose comments say what each key does.
std::string starter_scene(Starter starter);
