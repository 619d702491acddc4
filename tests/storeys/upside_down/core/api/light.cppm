module;

#include "candela/light.h"

export module candela.light;

import candela.files;

export namespace candela {
using candela::Light;
}
