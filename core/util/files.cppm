// Text from files, and atomic file writes.
module;

#include "candela/plugin/export.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

export module candela.util:files;

export namespace candela {

/// How to treat an existing file.
enum class Existing : bool { replaced, kept };

/// How to treat a symbolic link in the place of a file. A link under a name that the user gave is followed.
/// One under a name that Candela chose (a frame, a record, a plan) is not: whichever user made the folder may
/// have put a link to somebody else's file there.
enum class Links : bool { followed, not_followed };

/// Whether a file survives a crash of the machine, which requires waiting for the disk.
enum class Durability : bool { durable, fast };

/// Writes a file atomically: nobody ever sees a partial file, and after a failure, a kill or a crash of the
/// machine the previous contents remain. If the file system supports it, the file has no name until it is
/// complete, synced and closed; otherwise it is a temporary file in the same folder whose name begins with
/// ".candela-". Symbolic links are followed. The new file has the old one's permissions, but is never
/// set-user-ID, set-group-ID or sticky. "-" (standard output) and anything that is not a regular file (a
/// pipe, a device) are written to directly. With `Existing::kept`, an existing file is an error, even if it
/// was created meanwhile. With `Links::not_followed`, the file replaces a symbolic link, and anything else
/// that is not a regular file is an error. All members throw Error (failure). One thread at a time.
class CANDELA_EXPORT OutputFile {
  public:
    explicit OutputFile(const std::filesystem::path& path, Existing existing = Existing::replaced,
                        Links links = Links::followed);
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    /// Discards the file unless finish() was called.
    ~OutputFile();

    void write(std::span<const std::byte> bytes);
    void write(std::string_view text);
    /// Whether the file is a regular one, so that write_at() can be used, and then only write_at().
    bool is_random_access() const noexcept { return !target_.empty(); }
    /// Writes anywhere in the file, even past its end.
    void write_at(std::uint64_t offset, std::span<const std::byte> bytes);
    /// Call it after the last write(): does everything that may fail for lack of space. The file is then
    /// complete on the disk, under a temporary name. Of several files, the first can be put in place once all
    /// are complete.
    void complete();
    /// Moves the complete file to its destination. Call it once, after the last write() or complete().
    void finish(Durability durability = Durability::durable);

  private:
    class NameBeside;

    void sync();
    void close();
    bool give_permissions();
    void name_beside();
    void put_in_place(Durability durability);
    void rename_to_target();
    [[noreturn]] void fail_as_existing() const;

    std::string shown_;             // the path as given, for messages
    std::filesystem::path target_;  // the file to replace; empty if bytes are written directly
    std::unique_ptr<NameBeside> beside_;
    int descriptor_ = -1;
    Existing existing_;
    Links links_;
};

/// A regular file opened for reading. Opening anything else (a pipe, a device, a folder) fails, without
/// waiting. Does not use a stream, which mistakes a lack of memory for the end of the file. One thread at a
/// time.
class CANDELA_EXPORT RegularFile {
  public:
    explicit RegularFile(const std::filesystem::path& path, Links links = Links::followed);
    RegularFile(const RegularFile&) = delete;
    RegularFile& operator=(const RegularFile&) = delete;
    ~RegularFile();

    bool is_open() const noexcept { return is_regular_; }
    /// The size in bytes when the file was opened.
    std::uint64_t size() const noexcept { return size_; }
    /// Continues at this offset.
    bool seek(std::uint64_t offset) noexcept;
    /// Returns the number of bytes read: fewer than requested at the end of the file, nothing on failure.
    std::optional<std::size_t> read(std::span<char> bytes) noexcept;

  private:
    int descriptor_;
    bool is_regular_ = false;
    std::uint64_t size_ = 0;
};

/// The bytes of a regular file, or nothing if it cannot be read. Of a file larger than `most`, a little more
/// than `most` bytes.
CANDELA_EXPORT std::optional<std::string> read_text_file(const std::filesystem::path& path,
                                                         std::size_t most = std::string::npos,
                                                         Links links = Links::followed);

/// The names of a folder's entries, in no particular order, and at most `most` of them; nothing if it cannot
/// be read. Throws std::bad_alloc if out of memory; std::filesystem::directory_iterator would terminate the
/// program (libstdc++ 12).
CANDELA_EXPORT std::optional<std::vector<std::string>> names_in(const std::filesystem::path& folder,
                                                                std::size_t most = std::string::npos);

/// The path without links and dots, whether or not it exists; the path itself if that cannot be determined.
/// Throws std::bad_alloc if out of memory, which std::filesystem only reports as an error.
CANDELA_EXPORT std::filesystem::path canonical_path(const std::filesystem::path& path);

/// Writes a text through an OutputFile.
CANDELA_EXPORT void write_text_file(const std::filesystem::path& path, std::string_view text,
                                    Existing existing = Existing::replaced);

/// Removes the temporary files that exist at this moment; they will not be finished. For signal handlers
/// (async-signal-safe). A program that never calls it leaves them behind only if a signal ends the process.
CANDELA_EXPORT void remove_unfinished_files() noexcept;

}  // namespace candela
