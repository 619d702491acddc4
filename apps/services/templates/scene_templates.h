// The scenes written by `candela new`.
#pragma once

#include <string>

enum class Starter { image, film };

/// A valid scene whose comments explain each key.
std::string starter_scene(Starter starter);
