// Values of Python as those of a scene file.
#pragma once

#include "binding.h"

import candela.toml;

namespace candela::python {

/// None of its places is known but `file`, which stands for the value in messages. Throws TypeError for what
/// TOML does not have.
Node node_of(py::handle value, const std::string& file);

/// A dictionary as the text of a scene file, with a line for each value of a table.
std::string document_text(const py::dict& scene);

}  // namespace candela::python
