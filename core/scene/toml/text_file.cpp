module;

#include "candela/file_descriptor.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

module candela.scene;

import :text;
import candela.util;

namespace candela {

namespace {

namespace fs = std::filesystem;

/// The whole file, or slightly more than `most` if it is larger. Nothing, with errno, on failure.
std::optional<std::string> read_all(const FileDescriptor& file, std::uintmax_t most) {
    std::string text;
    std::array<char, 65536> part;
    for (;;) {
        const ssize_t count = ::read(file.number(), part.data(), part.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return std::nullopt;
        if (count == 0) return text;
        text.append(part.data(), static_cast<std::size_t>(count));
        if (text.size() > most) return text;
    }
}

bool is_utf16(std::string_view text) {
    return text.starts_with(std::string_view("\xff\xfe", 2)) ||
           text.starts_with(std::string_view("\xfe\xff", 2));
}

}  // namespace

SourceLocation place_at(std::string_view text, std::size_t offset, const std::string& shown_name) {
    const std::string_view before = text.substr(0, offset);
    const auto line = 1 + std::ranges::count(before, '\n');
    const std::size_t begin = before.rfind('\n') + 1;  // 0 on the first line
    return {shown_name, static_cast<int>(line), 1 + static_cast<int>(character_count(before.substr(begin))),
            1};
}

namespace {

std::string too_large(const std::string& size, std::uintmax_t bytes_left) {
    return fmt::format(
        "the file is too large: {} bytes, where {}{}", size,
        bytes_left < ReadingLimits::k_most_bytes ? "the files read before leave " : "a scene may have ",
        bytes_left);
}

}  // namespace

std::optional<std::string> text_of_file(const fs::path& file, const std::string& shown_name,
                                        std::uintmax_t& bytes_left, Diagnostics& diagnostics) {
    const auto fail = [&](const std::string& message, const std::string& hint = {}) {
        diagnostics.failure({shown_name, 0, 0, 0}, message, hint);
        return std::nullopt;
    };
    const auto fail_at_begin = [&](const std::string& message) {
        diagnostics.failure(place_at({}, 0, shown_name), message);
        return std::nullopt;
    };
    std::error_code problem;
    const fs::file_status status = fs::status(file, problem);
    if (status.type() == fs::file_type::not_found)
        return fail("there is no such file", file_suggestion(file));
    if (status.type() == fs::file_type::none)
        return fail(fmt::format("it cannot be examined: {}", problem.message()));
    if (status.type() == fs::file_type::directory) return fail("this is a directory; expected a scene file");
    if (status.type() != fs::file_type::regular)
        return fail("this is not a regular file (a pipe or a device?)");
    const std::uintmax_t size = fs::file_size(file, problem);
    if (!problem && size > bytes_left) return fail_at_begin(too_large(fmt::to_string(size), bytes_left));
    // Opening a file that is replaced after the check, for instance by a pipe, must not block.
    const FileDescriptor descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
    if (!descriptor.is_open())
        return fail_at_begin(fmt::format("the file cannot be opened: {}", std::strerror(errno)));
    auto text = read_all(descriptor, bytes_left);
    if (!text) return fail_at_begin(fmt::format("the file cannot be read: {}", std::strerror(errno)));
    return text_of_bytes(std::move(*text), shown_name, bytes_left, diagnostics);
}

std::optional<std::string> text_of_bytes(std::string text, const std::string& shown_name,
                                         std::uintmax_t& bytes_left, Diagnostics& diagnostics) {
    // Problems with a file as a whole are shown at its beginning, where an editor can open it.
    const SourceLocation place = place_at({}, 0, shown_name);
    const auto no_scene = [&](const std::string& message, const std::string& hint = {}) {
        diagnostics.error(place, message, hint);
        return std::nullopt;
    };
    // Some files, such as those in /proc, report no size.
    if (text.size() > bytes_left) {
        diagnostics.failure(place, too_large(fmt::format("more than {}", bytes_left), bytes_left));
        return std::nullopt;
    }
    bytes_left -= text.size();
    // Columns count visible characters, which a byte-order mark is not.
    if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
    if (text.find_first_not_of(" \t\r\n") == std::string::npos) return no_scene("the file is empty");
    if (is_utf16(text)) return no_scene("the file's text is UTF-16; a scene is UTF-8", "save it as UTF-8");
    if (const std::size_t at = text.find('\0'); at != std::string::npos) {
        diagnostics.error(place_at(text, at, shown_name), "this is a binary file; a scene is text (TOML)");
        return std::nullopt;
    }
    return text;
}

std::filesystem::path path_at(const SourceLocation& place, const std::string& written) {
    return (place.line > 0 ? std::filesystem::path(place.file).parent_path() : "") /
           std::filesystem::path(written);
}

std::optional<std::string> existing_file(const fs::path& file, const std::string& name,
                                         const SourceLocation& place, Diagnostics& diagnostics) {
    std::error_code problem;
    const fs::path absolute = fs::absolute(file, problem).lexically_normal();
    const fs::file_status status = fs::status(absolute, problem);
    if (status.type() == fs::file_type::regular) return absolute.string();
    const char* const what = status.type() == fs::file_type::directory   ? "is a directory, not a file"
                             : status.type() == fs::file_type::not_found ? "does not exist"
                                                                         : "is not a regular file";
    std::string hint;
    if (status.type() == fs::file_type::not_found) {
        const std::string meant = file_suggestion(file);
        hint = fmt::format("{}{}(looked for {})", meant, meant.empty() ? "" : "  ", absolute.string());
    }
    diagnostics.error(place, fmt::format("'{}' {}", name, what), hint);
    return std::nullopt;
}

}  // namespace candela
