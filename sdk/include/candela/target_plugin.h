// A target plugin: a class derived from candela::Target with a constructor that takes its parameters
// (candela::sdk::NoParams, usually), and
//
//     CANDELA_PLUGIN(target, MyTarget, candela::sdk::k_no_fields, {.title = …, .summary = …})
//
// What targets have in common (templates, literals, kernels as text, GLSL) is in the library candela::target,
// whose headers are candela/target/*.h.
#pragma once

#include "candela/plugin.h"
#include "candela/target.h"
