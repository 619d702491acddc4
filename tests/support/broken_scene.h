// Valid scenes with one constraint broken by chance.
#pragma once

#include <map>
#include <string>

#include "random_scene.h"

struct BrokenScene {
    std::string rule;     // which constraint, for messages and for counting
    std::string text;     // the whole file
    std::string message;  // what the error must say, among other things
    int line = 0;         // where it must be; 0: the rule is about something that is not there
};

/// The random scene of that seed with one thing changed so that exactly one constraint no longer holds.
BrokenScene broken_scene(unsigned seed);
