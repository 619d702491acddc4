// What a server shows.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "view/page.h"

namespace view {

/// A state of the scene as browsers get it. Immutable once published.
struct Publication {
    std::uint64_t generation = 0;      // of the page: 0 until there has been one
    std::shared_ptr<const Page> page;  // null until there has been one
    std::string problems;              // what is wrong with the scene as it is now, as a person reads it
};

}  // namespace view
