#include "candela/plugin.h"

import candela.files;
import candela.light;
