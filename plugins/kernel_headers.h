// Precompiled for all plugins that are a .kernel file.
#pragma once

// Their headers ask whether there is a kernel. Which one it is only matters where their macros are used.
#define CANDELA_KERNEL_FILE
#include "candela/light_plugin.h"
#include "candela/material_presets.h"
#include "candela/refraction_plugin.h"
#include "candela/shading_plugin.h"
#undef CANDELA_KERNEL_FILE
