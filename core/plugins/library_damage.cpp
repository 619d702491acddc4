module;

#include "candela/file_descriptor.h"

#include <dlfcn.h>
#include <elf.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <link.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

module candela.plugins;

import candela.util;

namespace candela {

namespace {

using Header = ElfW(Ehdr);
using Segment = ElfW(Phdr);
using Section = ElfW(Shdr);

class File {
  public:
    explicit File(const std::filesystem::path& path)
        : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
        struct stat status{};
        if (!descriptor_.is_open() || ::fstat(descriptor_.number(), &status) != 0) {
            // An error that may be temporary says nothing about the library.
            if (errno != EACCES && errno != ENOENT && errno != ELOOP)
                throw Error(ErrorCategory::failure,
                            fmt::format("'{}' cannot be read: {}", path.string(), std::strerror(errno)));
            problem_ = std::strerror(errno);
        } else if (!S_ISREG(status.st_mode)) {
            problem_ = "it is not a regular file";
        } else {
            size_ = static_cast<std::uint64_t>(status.st_size);
        }
    }

    const std::string& problem() const { return problem_; }
    std::uint64_t size() const { return size_; }
    bool holds(std::uint64_t offset, std::uint64_t count) const {
        return offset <= size_ && count <= size_ - offset;
    }
    /// Returns false if the file ends before.
    bool read(std::uint64_t offset, void* to, std::size_t count) const {
        return holds(offset, count) && ::pread(descriptor_.number(), to, count, static_cast<off_t>(offset)) ==
                                           static_cast<ssize_t>(count);
    }

  private:
    FileDescriptor descriptor_;
    std::string problem_;
    std::uint64_t size_ = 0;
};

template <class Entry>
std::vector<Entry> table_at(const File& file, std::uint64_t offset, std::size_t count) {
    std::vector<Entry> entries(count);
    if (!file.read(offset, entries.data(), count * sizeof(Entry))) entries.clear();
    return entries;
}

/// The header of the library that contains this code; null if unknown.
const Header* own_header() {
    Dl_info info{};
    const bool is_known = ::dladdr(reinterpret_cast<const void*>(&library_damage), &info) != 0;
    return is_known ? static_cast<const Header*>(info.dli_fbase) : nullptr;
}

bool is_of_this_machine(const Header& header) {
    static const Header* const own = own_header();  // finding it takes as long as checking a plugin's file
    return own == nullptr ||
           (std::memcmp(header.e_ident, own->e_ident, EI_VERSION) == 0 && header.e_machine == own->e_machine);
}

}  // namespace

std::string library_damage(const std::filesystem::path& library) {
    const File file(library);
    if (!file.problem().empty()) return file.problem();
    Header header{};
    if (!file.read(0, &header, sizeof header) || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0)
        return "it is not an ELF shared library";
    if (!is_of_this_machine(header)) return "it is a library for another processor architecture";
    const auto truncated = [&] { return fmt::format("it is truncated after {} bytes", file.size()); };
    if (header.e_phentsize != sizeof(Segment) || header.e_phnum == 0)
        return "it is not an ELF shared library that can be loaded";
    const auto segments = table_at<Segment>(file, header.e_phoff, header.e_phnum);
    if (segments.empty()) return truncated();
    for (const Segment& segment : segments) {
        if (!file.holds(segment.p_offset, segment.p_filesz)) return truncated();
    }
    // Stripped libraries may lack the section table, which is at the end of the file.
    if (header.e_shoff == 0 || header.e_shnum == 0) return {};
    if (header.e_shentsize != sizeof(Section)) return "its section table cannot be read";
    const auto sections = table_at<Section>(file, header.e_shoff, header.e_shnum);
    if (sections.empty()) return truncated();
    for (const Section& section : sections) {
        if (section.sh_type != SHT_NOBITS && !file.holds(section.sh_offset, section.sh_size))
            return truncated();
    }
    return {};
}

}  // namespace candela
