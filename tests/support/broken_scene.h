// Valid scenes with one randomly chosen constraint broken.
#pragma once

#include <map>
#include <string>

#include "random_scene.h"

struct BrokenScene {
    std::string rule;     // name of the constraint, for messages and for counting
    std::string text;     // the whole file
    std::string message;  // a part of the expected error
    int line = 0;         // where it must be; 0: the constraint is about something missing
};

/// The random scene of that seed with one change, so that exactly one constraint is violated.
BrokenScene broken_scene(unsigned seed);
