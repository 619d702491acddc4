#pragma once

#include "candela/kernel.h"
#include "candela/light.h"
