// Text from files, and atomic file writes.
module;

#include "candela/api.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

export module candela.files;

export namespace candela {

/// What becomes of a file that is there already.
enum class Existing : bool { replaced, kept };

/// What a symbolic link in the place of a file means. A name that a person gave is followed. A name that
/// Candela chose (a frame, a record, a plan) is not: whoever made the folder may have put a link there, to a
/// file of somebody else's.
enum class Links : bool { followed, not_followed };

/// Whether a file survives a crash of the machine, for which one has to wait for the disk.
enum class Durability : bool { durable, fast };

/// A file being written atomically: nobody ever sees a partial file, and a failure, a kill or a crash of the
/// machine leaves the previous contents. It has no name until it is complete, synced and closed, if the file
/// system supports that; otherwise it is a temporary file in the same folder whose name begins with
/// ".candela-". Symbolic links are followed; the new file may be read, written and executed by whoever might
/// do so with the old one, but is never set-user-ID, set-group-ID or sticky. "-", standard output, and
/// anything that is not a regular file (a pipe, a device) is written to directly. With `Existing::kept`,
/// there is an error if the file exists, also if it was made meanwhile. With `Links::not_followed`, a
/// symbolic link is replaced by the file, and anything else that is not a regular file is an error. All
/// members throw Error (failure). One thread at a time.
class CANDELA_API OutputFile {
  public:
    explicit OutputFile(const std::filesystem::path& path, Existing existing = Existing::replaced,
                        Links links = Links::followed);
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    /// Without a preceding finish(), nothing has happened.
    ~OutputFile();

    void write(std::span<const std::byte> bytes);
    void write(std::string_view text);
    /// Whether write_at() can be used, and then nothing else: it is a regular file.
    bool is_random_access() const noexcept { return !target_.empty(); }
    /// Writes somewhere in the file, also beyond its end.
    void write_at(std::uint64_t offset, std::span<const std::byte> bytes);
    /// Everything that may fail for want of space, after the last write(): the file is complete on the disk,
    /// under a temporary name. Of several files, the first can be put in place when all are complete.
    void complete();
    /// Moves the complete file to its destination. Call it once, after the last write(), or complete().
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
    std::filesystem::path target_;  // what is replaced; empty if bytes are written directly
    std::unique_ptr<NameBeside> beside_;
    int descriptor_ = -1;
    Existing existing_;
    Links links_;
};

/// A regular file that is open for reading. Anything else (a pipe, a device, a folder) counts as a file that
/// cannot be opened, and nobody waits for it. Not through a stream, which takes a lack of memory for the end
/// of the file. One thread at a time.
class CANDELA_API RegularFile {
  public:
    explicit RegularFile(const std::filesystem::path& path, Links links = Links::followed);
    RegularFile(const RegularFile&) = delete;
    RegularFile& operator=(const RegularFile&) = delete;
    ~RegularFile();

    bool is_open() const noexcept { return is_regular_; }
    /// In bytes, when it was opened.
    std::uint64_t size() const noexcept { return size_; }
    /// Continues at this offset.
    bool seek(std::uint64_t offset) noexcept;
    /// How many bytes were read: fewer than asked for at the end of the file; nothing if that failed.
    std::optional<std::size_t> read(std::span<char> bytes) noexcept;

  private:
    int descriptor_;
    bool is_regular_ = false;
    std::uint64_t size_ = 0;
};

/// The bytes of a regular file, or nothing if it cannot be read. Of a file larger than `most`, a little more
/// than `most` bytes.
CANDELA_API std::optional<std::string> read_text_file(const std::filesystem::path& path,
                                                      std::size_t most = std::string::npos,
                                                      Links links = Links::followed);

/// The names of what is in a folder, in no particular order, and no more than `most`; nothing if it cannot be
/// read. Without memory it throws std::bad_alloc, where std::filesystem::directory_iterator ends the program
/// (libstdc++ 12).
CANDELA_API std::optional<std::vector<std::string>> names_in(const std::filesystem::path& folder,
                                                             std::size_t most = std::string::npos);

/// The path without links and dots, whether or not anything is there; the path as it is where that cannot be
/// found out. Without memory it throws std::bad_alloc, where std::filesystem only reports an error.
CANDELA_API std::filesystem::path canonical_path(const std::filesystem::path& path);

/// Writes a text through an OutputFile.
CANDELA_API void write_text_file(const std::filesystem::path& path, std::string_view text,
                                 Existing existing = Existing::replaced);

/// Makes the folder `owned`, relative to `parent` and chosen by Candela, and the folders that both are in. No
/// part of `owned` may be a symbolic link. Throws Error (failure).
CANDELA_API void make_owned_folder(const std::filesystem::path& parent, const std::filesystem::path& owned);

/// A file's text as it was read, and the one that is to replace it.
struct TextChange {
    std::filesystem::path file;
    std::string before, after;
};

/// Replaces texts, all of them or none: if a file no longer holds what was read, another program has saved it
/// meanwhile, and nothing is written. Throws Error (failure).
CANDELA_API void replace_texts(std::span<const TextChange> changes);

/// Removes the temporary files that exist at this moment; they will not be finished. For signal handlers
/// (async-signal-safe). A program that never calls it leaves them behind only if a signal ends the process.
CANDELA_API void remove_unfinished_files() noexcept;

}  // namespace candela
