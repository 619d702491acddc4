#include "files/owned_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <system_error>
#include <utility>

#include "candela/file_descriptor.h"

namespace fs = std::filesystem;
using candela::Links;

namespace {

/// Opens a folder in another one, creating it if necessary. Not open, with errno, on failure.
candela::FileDescriptor open_inside(const candela::FileDescriptor& folder, const fs::path& name) {
    if (::mkdirat(folder.number(), name.c_str(), 0777) != 0 && errno != EEXIST) return {};
    return candela::FileDescriptor(
        ::openat(folder.number(), name.c_str(), O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
}

[[noreturn]] void fail_to_make(const fs::path& folder, const char* reason) {
    throw candela::Error(candela::ErrorCategory::failure,
                         fmt::format("the folder '{}' cannot be created: {}", folder.string(), reason));
}

}  // namespace

std::optional<std::string> read_owned_file(const fs::path& file, std::size_t most) {
    auto text = candela::read_text_file(file, most, Links::not_followed);
    return text && text->size() > most ? std::nullopt : text;
}

std::string end_of_owned_file(const fs::path& file, std::size_t most) {
    candela::RegularFile opened(file, Links::not_followed);
    if (!opened.is_open()) return "";
    const std::uint64_t size = std::min<std::uint64_t>(opened.size(), most);
    std::string text(static_cast<std::size_t>(size), '\0');
    if (!opened.seek(opened.size() - size)) return "";
    text.resize(opened.read(text).value_or(0));
    return text;
}

void write_owned_file(const fs::path& file, std::string_view text, candela::Durability durability) {
    candela::OutputFile output(file, candela::Existing::replaced, Links::not_followed);
    output.write(text);
    output.finish(durability);
}

void make_owned_folder(const fs::path& parent, const fs::path& owned) {
    std::error_code problem;
    fs::create_directories(parent, problem);
    if (problem) fail_to_make(parent, problem.message().c_str());
    candela::FileDescriptor folder(::open(parent.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
    if (!folder.is_open()) fail_to_make(parent, std::strerror(errno));
    fs::path shown = parent == "." ? "" : parent;
    for (const fs::path& name : owned) {
        shown /= name;
        candela::FileDescriptor inner = open_inside(folder, name);
        if (inner.is_open()) {
            folder = std::move(inner);
            continue;
        }
        // The kernel's error for a link depends on the link's target.
        const bool is_other = errno == ENOTDIR || errno == ELOOP;
        fail_to_make(shown, is_other ? "a link or a file is in its place; remove it" : std::strerror(errno));
    }
}
