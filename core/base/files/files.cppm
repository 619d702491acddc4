// Text from files, and atomic file writes.
module;

#include "candela/api.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

export module candela.files;

export namespace candela {

/// A file that is written: nobody ever finds half of it, and a failure or a kill leaves what was there
/// before. It has no name until it is whole, where the file system offers that; elsewhere it stands beside
/// its place under a name that begins with ".candela-". Through a link, what it leads to is replaced, not the
/// link; the new file has the rights of the old one. "-", standard output, and what is not a regular file (a
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

/// The bytes of a regular file, or nothing if it cannot be read. Of a file larger than `most`, a little more
/// than `most` bytes.
CANDELA_API std::optional<std::string> read_text_file(const std::filesystem::path& path,
                                                      std::size_t most = std::string::npos);

/// Writes a whole text as an OutputFile.
CANDELA_API void write_text_file(const std::filesystem::path& path, std::string_view text);

/// Removes the files that stand beside their places at this moment; they are not finished then. Made for
/// signal handlers (it is async-signal-safe); what is never called leaves them only where a signal ends the
/// process.
CANDELA_API void remove_unfinished_files() noexcept;

}  // namespace candela
