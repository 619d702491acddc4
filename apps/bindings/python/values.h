// Converts Python values to values of a scene file.
#pragma once

#include "binding.h"

import candela.scene;

namespace candela::python {

/// Only `file`, which stands for the value in messages, is set in its place. Throws TypeError for values that
/// TOML does not have.
Node node_of(py::handle value, const std::string& file);

/// A dictionary as the text of a scene file, with a line for each value of a table.
std::string document_text(const py::dict& scene);

}  // namespace candela::python
