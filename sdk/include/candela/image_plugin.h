// An image-format plugin: a class derived from candela::ImageFormat with a constructor that takes its
// parameters (candela::sdk::NoParams, usually), and
//
//     CANDELA_PLUGIN(image, MyFormat, candela::sdk::k_no_fields, {.title = …, .formats = k_formats})
#pragma once

#include "candela/plugin.h"

import candela.image;
