#include "candela/plugin.h"

import candela.api;
import candela.util;
