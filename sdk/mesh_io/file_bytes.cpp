#include "mesh_io/file_bytes.h"
#include "candela/parallel.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "mesh_io/bad_file.h"

namespace mesh_io {

namespace {

class Descriptor {
  public:
    explicit Descriptor(const std::filesystem::path& file)
        : number_(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
        if (number_ < 0) throw BadFile(fmt::format("cannot be read: {}", reason()));
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { ::close(number_); }

    std::size_t regular_size() const {
        struct stat status{};
        if (::fstat(number_, &status) != 0) throw BadFile(fmt::format("cannot be read: {}", reason()));
        if (!S_ISREG(status.st_mode)) throw BadFile("is not a regular file");
        return static_cast<std::size_t>(status.st_size);
    }

    void read(char* to, std::size_t begin, std::size_t count) const {
        while (count > 0) {
            const ::ssize_t done = ::pread(number_, to, count, static_cast<::off_t>(begin));
            if (done < 0 && errno == EINTR) continue;
            if (done < 0) throw BadFile(fmt::format("cannot be read: {}", reason()));
            if (done == 0) throw BadFile("was truncated while it was being read");
            const auto some = static_cast<std::size_t>(done);
            to += some, begin += some, count -= some;
        }
    }

    static std::string reason() { return std::generic_category().message(errno); }

  private:
    int number_;
};

constexpr std::string_view k_pointer = "version https://git-lfs.github.com/spec/";

/// The text that a clone without Git LFS has in place of the file.
void require_no_pointer(std::string_view text) {
    if (text.starts_with(k_pointer))
        throw BadFile("is a Git LFS pointer, not the file itself; run `git lfs pull` to fetch it");
}

}  // namespace

Array<char> read_file(const std::filesystem::path& file) {
    const Descriptor descriptor(file);
    Array<char> bytes(descriptor.regular_size());
    constexpr std::size_t k_stretch = std::size_t{4} << 20;
    candela::parallel_for(bytes.size(), k_stretch, [&](std::size_t begin, std::size_t end) {
        descriptor.read(bytes.data() + begin, begin, end - begin);
    });
    require_no_pointer(text_of(bytes));
    return bytes;
}

class Pieces::File : public Descriptor {
  public:
    using Descriptor::Descriptor;
};

Pieces::Pieces(const std::filesystem::path& file)
    : file_(std::make_unique<File>(file)), size_(file_->regular_size()) {
    require_no_pointer(at(0, std::min(size_, k_pointer.size())));
}

Pieces::~Pieces() = default;

std::string_view Pieces::at(std::size_t begin, std::size_t count) {
    piece_.resize(count);
    file_->read(piece_.data(), begin, count);
    return text_of(piece_);
}

FileState state_of(const std::filesystem::path& file) {
    struct stat status{};
    if (::stat(file.c_str(), &status) != 0) return {};
    return {static_cast<std::int64_t>(status.st_dev),
            static_cast<std::int64_t>(status.st_ino),
            status.st_size,
            status.st_mtim.tv_sec,
            status.st_mtim.tv_nsec,
            status.st_ctim.tv_sec,
            status.st_ctim.tv_nsec};
}

std::string_view without_mark(std::string_view text) {
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
        throw BadFile("is UTF-16 text; save it as UTF-8");
    constexpr std::string_view k_mark = "\xef\xbb\xbf";
    if (text.starts_with(k_mark)) text.remove_prefix(k_mark.size());
    return text;
}

std::filesystem::path part_named(const std::filesystem::path& file, const std::filesystem::path& folder,
                                 FileScope reach) {
    if (reach == FileScope::anywhere) return folder / file;
    const std::filesystem::path root = std::filesystem::weakly_canonical(folder.empty() ? "." : folder);
    std::filesystem::path real = std::filesystem::weakly_canonical(folder / file);
    const auto [end, unused] = std::ranges::mismatch(root, real);
    if (end != root.end())
        throw BadFile(
            fmt::format("names '{}', which is outside its own folder; if that is intended, set allow_outside "
                        "= true on the object or pass --allow-outside to the command",
                        file.string()));
    return real;
}

}  // namespace mesh_io
