// The handling of a generated C++ program's arguments.
#pragma once

#include <string>

#include "candela/target.h"

namespace candela::cpp_target {

/// A program with several models to choose from accepts their names.
struct ArgumentTexts {
    std::string usage;  // "[PICTURE [REFLECTION]]"
    std::string help;   // a line for each argument that names a model
    std::string main;   // the statements of main()
};
ArgumentTexts arguments_of(const ExportedScene& scene);

}  // namespace candela::cpp_target
