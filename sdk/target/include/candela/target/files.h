// Files that targets write.
#pragma once

#include <string_view>

#include "candela/target.h"

namespace candela::target {

void write(FileSink& files, const char* name, std::string_view content);

/// A part of a C++17 program that writes 8-bit pictures, put_number() to write_picture(): PNG and PPM.
std::string_view picture_file_source();

}  // namespace candela::target
