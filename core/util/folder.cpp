module;

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
#include <vector>

module candela.util;

namespace candela {

namespace {

/// An open folder, through which its contents are accessed.
class OpenFolder {
  public:
    explicit OpenFolder(int descriptor) : descriptor_(descriptor) {}
    OpenFolder(const OpenFolder&) = delete;
    OpenFolder& operator=(const OpenFolder&) = delete;
    ~OpenFolder() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }

    int number() const { return descriptor_; }
    /// Enters a folder in it, creating it if necessary. Returns false, with errno, on failure.
    bool enter(const std::filesystem::path& name) {
        if (::mkdirat(descriptor_, name.c_str(), 0777) != 0 && errno != EEXIST) return false;
        const int inner = ::openat(descriptor_, name.c_str(), O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
        if (inner < 0) return false;
        ::close(descriptor_);
        descriptor_ = inner;
        return true;
    }

  private:
    int descriptor_;
};

[[noreturn]] void fail_to_make(const std::filesystem::path& folder, const char* reason) {
    throw Error(ErrorCategory::failure,
                fmt::format("the folder '{}' cannot be created: {}", folder.string(), reason));
}

}  // namespace

void make_owned_folder(const std::filesystem::path& parent, const std::filesystem::path& owned) {
    std::error_code problem;
    std::filesystem::create_directories(parent, problem);
    if (problem) fail_to_make(parent, problem.message().c_str());
    OpenFolder folder(::open(parent.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
    if (folder.number() < 0) fail_to_make(parent, std::strerror(errno));
    std::filesystem::path shown = parent == "." ? "" : parent;
    for (const std::filesystem::path& name : owned) {
        shown /= name;
        if (folder.enter(name)) continue;
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
