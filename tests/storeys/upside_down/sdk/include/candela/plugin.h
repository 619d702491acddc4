#pragma once

#include "candela/kernel.h"
import candela.light;
