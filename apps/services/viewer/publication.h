// The state shown by a server.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "viewer/page.h"

namespace view {

/// A state of the scene as sent to browsers. Immutable once published.
struct Publication {
    std::uint64_t generation = 0;      // of the page; 0 before the first one
    std::shared_ptr<const Page> page;  // null before the first one
    std::string problems;              // the current errors of the scene, as text
};

}  // namespace view
