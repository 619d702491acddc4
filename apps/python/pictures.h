// Pictures as arrays of NumPy.
#pragma once

#include "binding.h"

import candela.film;

namespace candela::python {

/// (height, width, 3), of bytes or of floats as the film has them: the film's own memory, which lives as long
/// as the array.
py::array array_of(Film&& film);

/// The memory of a film of floats with `channels` of its three: (height, width) for one.
py::array array_of(Film&& film, int channels);

}  // namespace candela::python
