#pragma once

#include "candela/kernel/kernel.h"
#include "candela/light.h"
