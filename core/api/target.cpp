#include "candela/target.h"

#include <stdexcept>
#include <string>

namespace candela {

ExportedGeometry::~ExportedGeometry() = default;
FileSink::~FileSink() = default;
ProgramRunner::~ProgramRunner() = default;
Target::~Target() = default;

void FileSink::approximate(const char*) {}

void Target::build(const char*, ProgramRunner&) const {}

void Target::draw(const char*, const char*, ProgramRunner&) const {
    throw std::runtime_error("this target draws no picture");
}

int Target::show(const char* directory, ProgramRunner& programs) const {
    const std::string file = std::string(directory) + "/" + main_file();
    const char* const words[] = {"xdg-open", file.c_str()};
    return programs.show(words);
}

}  // namespace candela
