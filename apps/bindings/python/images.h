// Pictures as NumPy arrays.
#pragma once

#include "binding.h"

import candela.render;

namespace candela::python {

/// An array of shape (height, width, 3), of bytes or floats like the film's: the film's own memory, which
/// lives as long as the array.
py::array array_of(Film&& film);

/// The memory of a film of floats with `channels` of its three; (height, width) for one channel.
py::array array_of(Film&& film, int channels);

}  // namespace candela::python
