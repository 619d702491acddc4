module;

#include "candela/pool.h"

export module candela.pool;

export namespace candela {
using candela::Pool;
}
