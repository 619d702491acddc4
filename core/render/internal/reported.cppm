module;

#include <fmt/format.h>

#include <string>

module candela.render:reported;

import candela.util;

namespace candela {

/// Does `work` for a part of the scene, and reports an Error at its place.
template <class Work>
void reported(Diagnostics& diagnostics, const std::string& whose, const SourceLocation& place, Work work) {
    try {
        work();
    } catch (const Error& problem) {
        const std::string message = fmt::format("{}: {}", whose, problem.what());
        problem.category() == ErrorCategory::invalid_scene ? diagnostics.error(place, message)
                                                           : diagnostics.failure(place, message);
    }
}

}  // namespace candela
