#pragma once

#include "candela/plugin.h"
