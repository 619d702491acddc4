module;

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

module candela.files;

namespace candela {

namespace {

/// A regular file, open for reading; not through a stream, which takes a lack of memory for the end of the
/// file.
class RegularFile {
  public:
    explicit RegularFile(const std::filesystem::path& path)
        // What is no regular file must not block.
        : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {}
    RegularFile(const RegularFile&) = delete;
    RegularFile& operator=(const RegularFile&) = delete;
    ~RegularFile() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }

    bool is_open() const {
        struct stat status{};
        return descriptor_ >= 0 && ::fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode);
    }
    ssize_t read(std::array<char, 4096>& part) const {
        for (;;) {
            const ssize_t count = ::read(descriptor_, part.data(), part.size());
            if (count >= 0 || errno != EINTR) return count;
        }
    }

  private:
    int descriptor_;
};

}  // namespace

std::optional<std::string> read_text_file(const std::filesystem::path& path, std::size_t most) {
    const RegularFile file(path);
    if (!file.is_open()) return std::nullopt;
    std::string text;
    std::array<char, 4096> part{};
    while (text.size() <= most) {
        const ssize_t count = file.read(part);
        if (count < 0) return std::nullopt;
        if (count == 0) break;
        text.append(part.data(), static_cast<std::size_t>(count));
    }
    return text;
}

}  // namespace candela
