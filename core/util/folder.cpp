module;

#include "candela/file_descriptor.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

module candela.util;

namespace candela {

namespace {

/// Opens a folder in another one, creating it if necessary. Not open, with errno, on failure.
FileDescriptor open_inside(const FileDescriptor& folder, const std::filesystem::path& name) {
    if (::mkdirat(folder.number(), name.c_str(), 0777) != 0 && errno != EEXIST) return {};
    return FileDescriptor(
        ::openat(folder.number(), name.c_str(), O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
}

[[noreturn]] void fail_to_make(const std::filesystem::path& folder, const char* reason) {
    throw Error(ErrorCategory::failure,
                fmt::format("the folder '{}' cannot be created: {}", folder.string(), reason));
}

}  // namespace

void make_owned_folder(const std::filesystem::path& parent, const std::filesystem::path& owned) {
    std::error_code problem;
    std::filesystem::create_directories(parent, problem);
    if (problem) fail_to_make(parent, problem.message().c_str());
    FileDescriptor folder(::open(parent.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
    if (!folder.is_open()) fail_to_make(parent, std::strerror(errno));
    std::filesystem::path shown = parent == "." ? "" : parent;
    for (const std::filesystem::path& name : owned) {
        shown /= name;
        FileDescriptor inner = open_inside(folder, name);
        if (inner.is_open()) {
            folder = std::move(inner);
            continue;
        }
        // The kernel's error for a link depends on the link's target.
        const bool is_other = errno == ENOTDIR || errno == ELOOP;
        fail_to_make(shown, is_other ? "a link or a file is in its place; remove it" : std::strerror(errno));
    }
}

std::filesystem::path canonical_path(const std::filesystem::path& path) {
    std::error_code problem;
    const std::filesystem::path canonical = std::filesystem::weakly_canonical(path, problem);
    if (problem == std::errc::not_enough_memory) throw std::bad_alloc();
    return problem ? path : canonical;
}

std::optional<std::vector<std::string>> names_in(const std::filesystem::path& folder, std::size_t most) {
    constexpr auto k_close = [](DIR* directory) { ::closedir(directory); };
    const std::unique_ptr<DIR, decltype(k_close)> directory(::opendir(folder.c_str()), k_close);
    if (directory == nullptr) return std::nullopt;
    std::vector<std::string> names;
    while (names.size() < most) {
        errno = 0;
        const dirent* const entry = ::readdir(directory.get());
        if (entry == nullptr && errno != 0) return std::nullopt;
        if (entry == nullptr) break;
        const std::string_view name = static_cast<const char*>(entry->d_name);
        if (name != "." && name != "..") names.emplace_back(name);
    }
    return names;
}

}  // namespace candela
