// Files that are whole or not there.
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

/// A file that is written: nobody ever finds half of it, and a failure or a kill leaves what was there
/// before. It has no name until it is whole, where the file system offers that; elsewhere it stands beside
/// its place under a name that begins with ".candela-". Through a link, what it leads to is replaced, not the
/// link; the new file has the rights of the old one. "-", standard output, and what is no ordinary file (a
/// pipe, a device) is written to directly. All members throw Error (failure). One thread at a time.
class CANDELA_API OutputFile {
  public:
    explicit OutputFile(const std::filesystem::path& path);
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    /// Without finish() before, nothing has happened.
    ~OutputFile();

    void write(std::span<const std::byte> bytes);
    void write(std::string_view text);
    /// Puts the whole file in its place. To be called once, after the last write().
    void finish();

  private:
    class NameBeside;

    void close();
    void put_in_place();

    std::string shown_;             // the path as it was given, for messages
    std::filesystem::path target_;  // what is replaced; empty where bytes go out directly
    std::unique_ptr<NameBeside> beside_;
    int descriptor_ = -1;
};

/// Writes a whole text as an OutputFile.
CANDELA_API void write_text_file(const std::filesystem::path& path, std::string_view text);

/// Removes the files that stand beside their places at this moment; they are not finished then. Made for
/// signal handlers (it is async-signal-safe); what is never called leaves them only where a signal ends the
/// process.
CANDELA_API void remove_unfinished_files() noexcept;

}  // namespace candela

// What this module's own units share.
namespace candela {

/// A new name in a directory for a file to be; the file of that name goes away with this, and in
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
