module;

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

module candela.util;

namespace candela {

RegularFile::RegularFile(const std::filesystem::path& path, Links links)
    // Opening anything but a regular file must not block.
    : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY |
                                           (links == Links::not_followed ? O_NOFOLLOW : 0))) {
    struct stat status{};
    if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) return;
    is_regular_ = true;
    size_ = static_cast<std::uint64_t>(status.st_size);
}

RegularFile::~RegularFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

bool RegularFile::seek(std::uint64_t offset) noexcept {
    return ::lseek(descriptor_, static_cast<off_t>(offset), SEEK_SET) >= 0;
}

std::optional<std::size_t> RegularFile::read(std::span<char> bytes) noexcept {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t count = ::read(descriptor_, bytes.data() + done, bytes.size() - done);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return std::nullopt;
        if (count == 0) break;
        done += static_cast<std::size_t>(count);
    }
    return done;
}

std::optional<std::string> read_text_file(const std::filesystem::path& path, std::size_t most, Links links) {
    RegularFile file(path, links);
    if (!file.is_open()) return std::nullopt;
    std::string text;
    std::array<char, 4096> part{};
    while (text.size() <= most) {
        const auto count = file.read(part);
        if (!count) return std::nullopt;
        text.append(part.data(), *count);
        if (*count < part.size()) break;
    }
    return text;
}

}  // namespace candela
