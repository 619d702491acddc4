// What a generated C++ program does with its arguments.
#pragma once

#include <string>

#include "candela/target.h"

namespace candela::cpp_target {

/// A program in which there are several models to choose from takes their names.
struct ArgumentTexts {
    std::string usage;  // "[PICTURE [REFLECTION]]"
    std::string help;   // a line for each argument that names a model
    std::string main;   // the statements of main()
};
ArgumentTexts arguments_of(const ExportedScene& scene);

}  // namespace candela::cpp_target
