// Reads a file's content.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

#include "mesh_io/array.h"

namespace mesh_io {

/// Reads a whole file at once, so that later changes to the file have no effect (a mapped file that shrinks
/// kills the process). Throws BadFile if it is not a regular file or cannot be read; never blocks on a pipe.
Array<char> read_file(const std::filesystem::path& file);

/// A file that is read in pieces, so that a large one does not need to fit into memory.
class Pieces {
  public:
    /// Throws BadFile like read_file().
    explicit Pieces(const std::filesystem::path& file);
    Pieces(const Pieces&) = delete;
    Pieces& operator=(const Pieces&) = delete;
    ~Pieces();

    /// The size when the file was opened.
    std::size_t size() const { return size_; }
    /// A range of bytes within size(), valid until the next call. Throws BadFile if the file has been
    /// truncated or cannot be read.
    std::string_view at(std::size_t begin, std::size_t count);

  private:
    class File;

    std::unique_ptr<File> file_;
    std::size_t size_;
    Array<char> piece_;
};

/// Values that differ once a file has changed: its location, size and times; all zero if it is absent.
using FileState = std::array<std::int64_t, 7>;
FileState state_of(const std::filesystem::path& file);

/// The files that a file may name as parts of itself.
enum class FileScope : bool { its_folder, anywhere };

/// The path of `file`, as named by a file in `folder`. Throws BadFile if `reach` does not allow its location
/// after links are resolved.
std::filesystem::path part_named(const std::filesystem::path& file, const std::filesystem::path& folder,
                                 FileScope reach);

inline std::string_view text_of(const Array<char>& bytes) { return {bytes.data(), bytes.size()}; }

/// The text without its UTF-8 byte order mark, if any. Throws BadFile for UTF-16.
std::string_view without_mark(std::string_view text);

}  // namespace mesh_io
