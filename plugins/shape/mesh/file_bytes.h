// A file's content.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

#include "surface.h"

namespace mesh {

/// A whole file, read at once: what happens to the file afterwards cannot be seen (a mapped file that shrinks
/// ends the process). Throws BadFile if it is no regular file or cannot be read; a pipe is not waited for.
Array<char> read_file(const std::filesystem::path& file);

/// A file that is read piece by piece, so that a large one needs no memory of its own size.
class Pieces {
  public:
    /// Throws BadFile as read_file() does.
    explicit Pieces(const std::filesystem::path& file);
    Pieces(const Pieces&) = delete;
    Pieces& operator=(const Pieces&) = delete;
    ~Pieces();

    /// When it was opened.
    std::size_t size() const { return size_; }
    /// Bytes that lie within the size, until the next call. Throws BadFile if the file has become shorter or
    /// cannot be read.
    std::string_view at(std::size_t begin, std::size_t count);

  private:
    class File;

    std::unique_ptr<File> file_;
    std::size_t size_;
    Array<char> piece_;
};

/// What differs once a file has been changed: where it is, its size and its times; all zero if it is absent.
using FileState = std::array<std::int64_t, 7>;
FileState state_of(const std::filesystem::path& file);

/// Which files a file may name as parts of itself.
enum class Reach : bool { its_folder, anywhere };

/// The path of `file`, a name in a file in `folder`. Throws BadFile if it lies, once links are resolved,
/// where `reach` does not allow.
std::filesystem::path part_named(const std::filesystem::path& file, const std::filesystem::path& folder,
                                 Reach reach);

inline std::string_view text_of(const Array<char>& bytes) { return {bytes.data(), bytes.size()}; }

/// The text behind a UTF-8 byte order mark, if it begins with one. Throws BadFile for UTF-16.
std::string_view without_mark(std::string_view text);

}  // namespace mesh
