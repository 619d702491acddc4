#include "verify/comparison.h"

#include <fmt/format.h>

#include "process/process.h"

import candela.util;

using candela::Error;
using candela::ErrorCategory;
namespace fs = std::filesystem;

namespace verify {

Comparison compare(const fs::path& program, const fs::path& a, const fs::path& b, const fs::path& edges,
                   const fs::path& heat_map, const fs::path& decoded) {
    const candela::ProgramOutput result =
        candela::run_program({program.string(), a.string(), b.string(), "--mask", edges.string(), "-o",
                              heat_map.string(), "--decoded", decoded.string(), "--json"});
    if (result.exit_code != 0)
        throw Error(ErrorCategory::failure, fmt::format("the pictures cannot be compared:\n{}", result.err));
    try {
        return comparison_from_json(result.out);
    } catch (const Error& problem) {
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' printed no valid figures: {}", program.string(), problem.what()));
    }
}

}  // namespace verify
