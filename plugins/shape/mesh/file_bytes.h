// A file's content.
#pragma once

#include <filesystem>
#include <string_view>

#include "surface.h"

namespace mesh {

/// A whole file, read at once: what happens to the file afterwards cannot be seen (a mapped file that shrinks
/// ends the process). Throws BadFile if it is no regular file or cannot be read; a pipe is not waited for.
Array<char> read_file(const std::filesystem::path& file);

/// `file`, if it lies in `folder` or below it once links are resolved; throws BadFile otherwise.
std::filesystem::path require_below(const std::filesystem::path& folder, const std::filesystem::path& file);

inline std::string_view text_of(const Array<char>& bytes) { return {bytes.data(), bytes.size()}; }

}  // namespace mesh
