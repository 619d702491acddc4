// Files that are whole or not there.
module;

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

module candela.film;

import candela.diagnostics;

namespace candela {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const char* what) {
    throw Error(ExitCode::failure, fmt::format("'{}' {}: {}", path.string(), what, std::strerror(errno)));
}

/// Bytes into a file descriptor.
class DescriptorSink final : public ByteSink {
  public:
    DescriptorSink(int descriptor, fs::path shown) : descriptor_(descriptor), shown_(std::move(shown)) {}

    void write(std::span<const std::byte> bytes) override {
        while (!bytes.empty()) {
            const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) fail(shown_, "cannot be written");
            bytes = bytes.subspan(static_cast<std::size_t>(written));
        }
    }

  private:
    int descriptor_;
    fs::path shown_;
};

/// A new file beside `target`; it takes the target's place when it is complete, and goes away if it never is.
class FileBeside {
  public:
    explicit FileBeside(fs::path target) : target_(std::move(target)) {
        fs::path const pattern = target_.parent_path() / ("." + target_.filename().string() + ".XXXXXX");
        std::string name = pattern.string();
        descriptor_ = ::mkstemp(name.data());
        if (descriptor_ < 0) fail(target_, "cannot be created");
        beside_ = name;
    }
    FileBeside(const FileBeside&) = delete;
    FileBeside& operator=(const FileBeside&) = delete;
    ~FileBeside() {
        if (descriptor_ >= 0) ::close(descriptor_);
        if (!beside_.empty()) ::unlink(beside_.c_str());
    }

    int descriptor() const { return descriptor_; }

    void take_place() {
        // mkstemp makes files for their owner only; a picture has the rights that any new file, or the old
        // picture, has.
        struct stat before{};
        mode_t mode = 0;
        if (::stat(target_.c_str(), &before) == 0) {
            mode = before.st_mode & 07777;
        } else {
            const mode_t mask = ::umask(0);
            ::umask(mask);
            mode = 0666 & ~mask;
        }
        if (::fchmod(descriptor_, mode) != 0) fail(target_, "cannot be given its rights");
        if (::close(std::exchange(descriptor_, -1)) != 0) fail(target_, "cannot be written");
        if (::rename(beside_.c_str(), target_.c_str()) != 0) fail(target_, "cannot be replaced");
        beside_.clear();
    }

  private:
    fs::path target_;
    std::string beside_;
    int descriptor_ = -1;
};

/// Whether writing means filling a file that can be replaced; not for a pipe or a device.
bool is_replaceable(const fs::path& path) {
    std::error_code problem;
    const fs::file_status status = fs::status(path, problem);
    return status.type() == fs::file_type::not_found || status.type() == fs::file_type::regular;
}

}  // namespace

PictureFormat format_of(const fs::path& path, Registry& registry) {
    if (path == "-") return {.plugin = "png", .extension = "png", .pixels = PixelType::byte};
    std::string extension = path.extension().string();
    if (!extension.empty()) extension.erase(0, 1);
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const PluginFile* const plugin = extension.empty() ? nullptr : registry.find_format(extension);
    if (plugin == nullptr) {
        const std::vector<std::string> all = registry.extensions();
        const auto near = closest(extension, all);
        throw Error(
            ExitCode::usage,
            fmt::format("'{}' {}{} (possible: {})", path.string(),
                        extension.empty() ? "has no extension that names a picture format"
                                          : fmt::format("is of no format that an image plugin writes"),
                        near && !extension.empty() ? fmt::format("; did you mean '.{}'?", *near) : "",
                        fmt::join(all, ", ")));
    }
    const auto& formats = plugin->manifest.formats;
    const auto format =
        std::ranges::find_if(formats, [&](const ManifestFormat& f) { return f.extension == extension; });
    return {.plugin = plugin->manifest.name, .extension = extension, .pixels = format->pixels};
}

void write_picture(const Film& film, const PictureFormat& format, const fs::path& path, Registry& registry) {
    const auto writer = registry.create<ImageFormat>(
        format.plugin, registry.parameters(PluginKind::image, format.plugin), film.view().encoding);
    const auto write_to = [&](int descriptor) {
        DescriptorSink sink(descriptor, path);
        try {
            writer->write(film.view(), format.extension.c_str(), sink);
        } catch (...) {
            rethrow_as_plugin_error(PluginKind::image, format.plugin);
        }
    };
    if (path == "-") return write_to(STDOUT_FILENO);
    std::error_code problem;
    if (fs::is_directory(path, problem)) {
        throw Error(ExitCode::failure,
                    fmt::format("'{}' is a directory; a picture is a file", path.string()));
    }
    if (!is_replaceable(path)) {
        const int descriptor = ::open(path.c_str(), O_WRONLY);
        if (descriptor < 0) fail(path, "cannot be opened");
        const std::unique_ptr<const int, void (*)(const int*)> closer(&descriptor,
                                                                      [](const int* d) { ::close(*d); });
        return write_to(descriptor);
    }
    // Through a link, what it leads to is replaced, not the link.
    const fs::path target = fs::is_symlink(path, problem) ? fs::weakly_canonical(path, problem) : path;
    FileBeside file(target);
    write_to(file.descriptor());
    file.take_place();
}

}  // namespace candela
