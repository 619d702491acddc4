module;

#include "candela/light.h"

export module candela.api;

import candela.util;

export namespace candela {
using candela::Light;
}
