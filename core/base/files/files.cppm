// Atomic file writes.
module;

#include "candela/api.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

export module candela.files;

import candela.diagnostics;

export namespace candela {

/// A file being written atomically: nobody ever sees a partial file, and a failure or a kill leaves the
/// previous contents. It has no name until it is complete, if the file system supports that; otherwise it is
/// a temporary file in the same folder whose name begins with ".candela-". Symbolic links are followed; the
/// new file has the permissions of the old one. "-", standard output, and anything that is not a regular file
/// (a pipe, a device) is written to directly. All members throw Error (failure). One thread at a time.
class CANDELA_API OutputFile {
  public:
    explicit OutputFile(const std::filesystem::path& path);
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    /// Without a preceding finish(), nothing has happened.
    ~OutputFile();

    void write(std::span<const std::byte> bytes);
    void write(std::string_view text);
    /// Moves the complete file to its destination. Call it once, after the last write().
    void finish();

  private:
    class NameBeside;

    void close();
    void put_in_place();

    std::string shown_;             // the path as given, for messages
    std::filesystem::path target_;  // what is replaced; empty if bytes are written directly
    std::unique_ptr<NameBeside> beside_;
    int descriptor_ = -1;
};

/// Writes a text through an OutputFile.
CANDELA_API void write_text_file(const std::filesystem::path& path, std::string_view text);

/// Removes the temporary files that exist at this moment; they will not be finished. For signal handlers
/// (async-signal-safe). A program that never calls it leaves them behind only if a signal ends the process.
CANDELA_API void remove_unfinished_files() noexcept;

}  // namespace candela

// What this module's own units share.
namespace candela {

/// A new name in a directory for a temporary file; the file of that name is removed in the destructor, and by
/// remove_unfinished_files().
class OutputFile::NameBeside {
  public:
    explicit NameBeside(const std::filesystem::path& directory);
    NameBeside(const NameBeside&) = delete;
    NameBeside& operator=(const NameBeside&) = delete;
    ~NameBeside();

    const char* c_str() const { return name_->c_str(); }

  private:
    std::unique_ptr<std::string> name_;
    std::atomic<std::string*>* slot_ = nullptr;
};

}  // namespace candela
