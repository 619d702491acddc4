module;

#include "candela/file_descriptor.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

module candela.util;

import :unfinished;

namespace candela {

namespace {

namespace fs = std::filesystem;

/// If the folder is missing, "No such file or directory" would sound as if the file had to exist already.
void require_folder_of(const std::string& shown) {
    const fs::path folder = fs::path(shown).parent_path();
    struct stat status{};
    if (folder.empty() || ::stat(folder.c_str(), &status) == 0 || errno != ENOENT) return;
    throw Error(
        ErrorCategory::failure,
        fmt::format(
            "'{}' cannot be written: there is no folder '{}'; create it first, or choose another name", shown,
            folder.string()));
}

[[noreturn]] void fail(const std::string& shown, const char* what, int problem = errno) {
    throw Error(ErrorCategory::failure, fmt::format("'{}' {}: {}", shown, what, std::strerror(problem)));
}

/// The target of a link, even if nothing exists there yet.
fs::path behind_links(fs::path path) {
    constexpr int k_most_links = 40;  // the limit of Linux
    std::error_code problem;
    for (int i = 0; i < k_most_links && fs::is_symlink(path, problem); ++i) {
        const fs::path next = fs::read_symlink(path, problem);
        if (problem) break;
        path = path.parent_path() / next;
    }
    return path;
}

fs::path directory_of(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// Queries what is at a path. Returns false, with errno ENOENT, if there is nothing, or a link that is to be
/// replaced.
bool found(const fs::path& path, Links links, struct stat& status) {
    if (links == Links::followed) return ::stat(path.c_str(), &status) == 0;
    if (::lstat(path.c_str(), &status) != 0) return false;
    if (S_ISLNK(status.st_mode)) errno = ENOENT;
    return !S_ISLNK(status.st_mode);
}

/// Opens a file without a name, or returns -1 if the file system does not support it (or /proc, through which
/// the file gets its name, is not mounted).
int open_unnamed(const fs::path& directory, mode_t mode) {
    if (::access("/proc/self/fd", X_OK) != 0) return -1;
    return ::open(directory.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, mode);
}

/// Gives a nameless file an unused name. Returns false, with errno, on failure.
bool name_file(int descriptor, const char* name) {
    const std::string self = fmt::format("/proc/self/fd/{}", descriptor);
    return ::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name, AT_SYMLINK_FOLLOW) == 0;
}

/// Another descriptor of a nameless file, which keeps it while it is closed, because errors on closing it
/// must be known before it gets its name. Not open, with errno, on failure.
FileDescriptor handle_of(int descriptor) {
    return FileDescriptor(::open(fmt::format("/proc/self/fd/{}", descriptor).c_str(), O_PATH | O_CLOEXEC));
}

}  // namespace

class OutputFile::NameBeside : public UnfinishedName {
  public:
    using UnfinishedName::UnfinishedName;
};

OutputFile::OutputFile(const fs::path& path, Existing existing, Links links)
    : shown_(path.string()), existing_(existing), links_(links) {
    if (path == "-") {
        descriptor_ = STDOUT_FILENO;
        return;
    }
    struct stat before{};
    const bool is_there = found(path, links_, before);
    if (!is_there && errno != ENOENT) fail(shown_, "cannot be written");
    if (is_there && S_ISDIR(before.st_mode)) {
        throw Error(ErrorCategory::failure, fmt::format("'{}' is a directory; expected a file name", shown_));
    }
    if (is_there && !S_ISREG(before.st_mode)) {
        if (links_ == Links::not_followed) {
            throw Error(
                ErrorCategory::failure,
                fmt::format("'{}' is a pipe, a socket or a device; expected a regular file or nothing: "
                            "remove it",
                            shown_));
        }
        descriptor_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
        if (descriptor_ < 0) fail(shown_, "cannot be opened");
        return;
    }
    if (is_there && existing_ == Existing::kept) fail_as_existing();
    if (!is_there) require_folder_of(shown_);
    target_ = links_ == Links::followed ? behind_links(path) : path;
    // Nobody else may read the new version of a private file while it is being written; see put_in_place().
    const mode_t mode = is_there ? 0600 : 0666;
    descriptor_ = open_unnamed(directory_of(target_), mode);
    if (descriptor_ >= 0) return;
    beside_ = std::make_unique<NameBeside>(directory_of(target_));
    descriptor_ = ::open(beside_->c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, mode);
    if (descriptor_ < 0) fail(shown_, "cannot be created");
}

OutputFile::~OutputFile() {
    if (descriptor_ >= 0 && descriptor_ != STDOUT_FILENO) ::close(descriptor_);
}

void OutputFile::write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail(shown_, "cannot be written");
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

void OutputFile::write_at(std::uint64_t offset, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail(shown_, "cannot be written");
        offset += static_cast<std::uint64_t>(written);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

void OutputFile::write(std::string_view text) { write(std::as_bytes(std::span(text))); }

void OutputFile::finish(Durability durability) {
    if (!target_.empty()) return put_in_place(durability);
    if (descriptor_ != STDOUT_FILENO) close();
}

void OutputFile::sync() {
    // Some file systems do not support syncing.
    if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP)
        fail(shown_, "cannot be written to the disk");
}

void OutputFile::close() {
    if (::close(std::exchange(descriptor_, -1)) != 0) fail(shown_, "cannot be written");
}

void OutputFile::fail_as_existing() const {
    throw Error(ErrorCategory::failure, fmt::format("'{}' already exists; not overwriting it", shown_));
}

/// Gives the new file the permissions of the file that it will replace. Returns whether there is one.
bool OutputFile::give_permissions() {
    struct stat before{};
    const bool is_there = found(target_, links_, before);
    if (is_there && existing_ == Existing::kept) fail_as_existing();
    // A set-user-ID program's replacement must not inherit its privileges.
    if (is_there && ::fchmod(descriptor_, before.st_mode & 0777) != 0)
        fail(shown_, "cannot be given its permissions");
    return is_there;
}

void OutputFile::name_beside() {
    if (beside_ != nullptr) return close();
    const FileDescriptor handle = handle_of(descriptor_);
    if (!handle.is_open()) fail(shown_, "cannot be moved into place");
    close();
    beside_ = std::make_unique<NameBeside>(directory_of(target_));
    if (!name_file(handle.number(), beside_->c_str())) fail(shown_, "cannot be moved into place");
}

void OutputFile::complete() {
    if (target_.empty() || descriptor_ < 0) return;
    give_permissions();
    sync();
    name_beside();
}

void OutputFile::put_in_place(Durability durability) {
    if (descriptor_ < 0) return rename_to_target();
    const bool is_there = give_permissions();
    if (durability == Durability::durable) sync();
    if (beside_ == nullptr && (!is_there || existing_ == Existing::kept)) {
        const FileDescriptor handle = handle_of(descriptor_);
        if (!handle.is_open()) fail(shown_, "cannot be moved into place");
        close();
        if (name_file(handle.number(), target_.c_str())) return;
        if (errno != EEXIST) fail(shown_, "cannot be moved into place");
        if (existing_ == Existing::kept) fail_as_existing();
        beside_ = std::make_unique<NameBeside>(directory_of(target_));
        if (!name_file(handle.number(), beside_->c_str())) fail(shown_, "cannot be moved into place");
    } else {
        // Only an unused name can be given: if killed between this and the renaming, the process leaves a
        // (complete) file next to the old one.
        name_beside();
    }
    rename_to_target();
}

void OutputFile::rename_to_target() {
    if (existing_ == Existing::kept) {
        if (::link(beside_->c_str(), target_.c_str()) == 0) return;
        if (errno == EEXIST) fail_as_existing();
        fail(shown_, "cannot be moved into place");
    }
    if (::rename(beside_->c_str(), target_.c_str()) != 0) fail(shown_, "cannot be replaced");
}

void write_text_file(const fs::path& path, std::string_view text, Existing existing) {
    OutputFile file(path, existing);
    file.write(text);
    file.finish();
}

}  // namespace candela
