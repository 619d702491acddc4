// An image-format plugin: a class derived from candela::ImageFormat whose constructor takes its parameters
// (usually candela::sdk::NoParams), and
//
//     CANDELA_PLUGIN(image, MyFormat, candela::sdk::k_no_fields, {.title = …, .formats = k_formats})
#pragma once

#include "candela/image.h"
#include "candela/picture_rows.h"
#include "candela/plugin.h"
