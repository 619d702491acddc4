// The files that a target makes of a scene.
#pragma once

#include <string>
#include <vector>

import candela.api;

namespace candela {

struct ExportedFile {
    std::string name;  // relative; without ".."
    std::string content;
};

/// The files that a target makes of a scene.
struct ExportedProgram {
    std::vector<ExportedFile> files;
    std::vector<std::string> approximations;  // what it expresses only approximately: FileSink::approximate()
};

/// Throws Error that names the target if write() throws, or if a file's name leads outside the folder or
/// occurs twice. `name`: the target's.
ExportedProgram program_of(const Target& target, const std::string& name, const ExportedScene& scene);

}  // namespace candela
