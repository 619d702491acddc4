#include "candela/target/files.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <span>
#include <stdexcept>
#include <system_error>

#include "candela/embed.h"

CANDELA_EMBED(candela_target_picture_file, CANDELA_TARGET_TEMPLATES "/picture_file.h");

namespace candela::target {

void write(FileSink& files, const char* name, std::string_view content) {
    files.write(name, std::as_bytes(std::span(content)));
}

TemporaryFolder::TemporaryFolder(std::string_view name, const std::filesystem::path& parent) {
    std::string path = (parent / name).string() + "-XXXXXX";
    if (::mkdtemp(path.data()) == nullptr)
        throw std::runtime_error("cannot create a folder in " + parent.string());
    path_ = path;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

void write_whole(const std::filesystem::path& file, std::string_view content) {
    std::filesystem::path part = file;
    part += ".part";
    // The existing file may be a link to a file of somebody else's.
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    const int descriptor = ::open(part.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    bool is_written = descriptor >= 0;
    while (is_written && !content.empty()) {
        const ssize_t count = ::write(descriptor, content.data(), content.size());
        if (count > 0) content.remove_prefix(static_cast<std::size_t>(count));
        is_written = count > 0 || (count < 0 && errno == EINTR);
    }
    if (descriptor >= 0 && ::close(descriptor) != 0) is_written = false;
    if (!is_written) {
        std::filesystem::remove(part, ignored);
        throw std::runtime_error("'" + file.string() + "' cannot be written");
    }
    std::filesystem::rename(part, file);
}

std::string_view image_file_source() { return candela_target_picture_file; }

}  // namespace candela::target
