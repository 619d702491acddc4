// A target plugin: a class derived from candela::Target whose constructor takes its parameters (usually
// candela::sdk::NoParams), and
//
//     CANDELA_PLUGIN(target, MyTarget, candela::sdk::k_no_fields, {.title = …, .summary = …})
//
// The library candela::target has what targets share (templates, literals, kernels as text, GLSL); its
// headers are candela/target/*.h.
#pragma once

#include "candela/plugin.h"
#include "candela/target.h"
