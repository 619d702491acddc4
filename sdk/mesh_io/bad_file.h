// The exception of all readers.
#pragma once

#include <stdexcept>

namespace mesh_io {

/// An invalid file. The message is a predicate without the file's name.
struct BadFile : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace mesh_io
