module;

#include "candela/parallel.h"

export module candela.parallel;

export namespace candela {
using candela::available_threads;
using candela::FunctionRef;
using candela::parallel_for;
using candela::with_threads;
}  // namespace candela
