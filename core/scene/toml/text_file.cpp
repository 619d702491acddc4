module;

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

module candela.toml;

import candela.diagnostics;

namespace candela {

namespace {

namespace fs = std::filesystem;

class Descriptor {
  public:
    explicit Descriptor(const fs::path& file)
        // A file that is replaced after the check, for instance by a pipe, must not block.
        : number_(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (number_ >= 0) ::close(number_);
    }
    bool is_open() const { return number_ >= 0; }

    /// The whole file, or slightly more than `most` if it is larger. Nothing, with errno, on failure.
    std::optional<std::string> read(std::uintmax_t most) const {
        std::string text;
        std::array<char, 65536> part;
        for (;;) {
            const ssize_t count = ::read(number_, part.data(), part.size());
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) return std::nullopt;
            if (count == 0) return text;
            text.append(part.data(), static_cast<std::size_t>(count));
            if (text.size() > most) return text;
        }
    }

  private:
    int number_;
};

/// The number of bytes of the character at the start of `rest`; 0 if it is not valid UTF-8 (RFC 3629).
std::size_t character_length(std::string_view rest) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(rest[i]); };
    const unsigned char first = byte(0);
    if (first < 0x80) return 1;
    const std::size_t length = first >= 0xc2 && first <= 0xdf   ? 2
                               : first >= 0xe0 && first <= 0xef ? 3
                               : first >= 0xf0 && first <= 0xf4 ? 4
                                                                : 0;
    if (length == 0 || rest.size() < length) return 0;
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xc0) != 0x80) return 0;
    }
    // Overlong forms, surrogates, beyond U+10FFFF.
    if ((first == 0xe0 && byte(1) < 0xa0) || (first == 0xed && byte(1) > 0x9f)) return 0;
    if ((first == 0xf0 && byte(1) < 0x90) || (first == 0xf4 && byte(1) > 0x8f)) return 0;
    return length;
}

bool is_utf16(std::string_view text) {
    return text.starts_with(std::string_view("\xff\xfe", 2)) ||
           text.starts_with(std::string_view("\xfe\xff", 2));
}

}  // namespace

std::optional<SourcePlace> first_invalid_character(std::string_view text, const std::string& shown_name) {
    SourcePlace place{shown_name, 1, 1, 1};
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = character_length(text.substr(i));
        if (length == 0) return place;
        if (text[i] == '\n') {
            ++place.line;
            place.column = 1;
        } else {
            ++place.column;
        }
        i += length;
    }
    return std::nullopt;
}

std::optional<std::string> text_of_file(const fs::path& file, const std::string& shown_name,
                                        ReadingLimits& left, Diagnostics& diagnostics) {
    const SourcePlace place{shown_name, 0, 0, 0};
    const auto fail = [&](const std::string& message, const std::string& hint = {}) {
        diagnostics.failure(place, message, hint);
        return std::nullopt;
    };
    const auto no_scene = [&](const std::string& message, const std::string& hint = {}) {
        diagnostics.error(place, message, hint);
        return std::nullopt;
    };
    const auto too_large = [&](const std::string& size) {
        return fail(fmt::format(
            "the file is too large: {} bytes, where {}{}", size,
            left.bytes < ReadingLimits::k_most_bytes ? "the files read before leave " : "a scene may have ",
            left.bytes));
    };
    std::error_code problem;
    const fs::file_status status = fs::status(file, problem);
    if (status.type() == fs::file_type::not_found)
        return fail("there is no such file", file_suggestion(file));
    if (status.type() == fs::file_type::none)
        return fail(fmt::format("it cannot be looked at: {}", problem.message()));
    if (status.type() == fs::file_type::directory) return fail("this is a directory; a scene is a file");
    if (status.type() != fs::file_type::regular)
        return fail("this is no ordinary file (a pipe or a device?)");
    const std::uintmax_t size = fs::file_size(file, problem);
    if (!problem && size > left.bytes) return too_large(fmt::to_string(size));
    const Descriptor descriptor(file);
    if (!descriptor.is_open())
        return fail(fmt::format("the file cannot be opened: {}", std::strerror(errno)));
    auto text = descriptor.read(left.bytes);
    if (!text) return fail(fmt::format("the file cannot be read: {}", std::strerror(errno)));
    // Some files, such as those in /proc, report no size.
    if (text->size() > left.bytes) return too_large(fmt::format("more than {}", left.bytes));
    left.bytes -= text->size();
    // Columns count what is visible, which a byte-order mark is not.
    if (text->starts_with("\xef\xbb\xbf")) text->erase(0, 3);
    if (text->find_first_not_of(" \t\r\n") == std::string::npos) return no_scene("the file is empty");
    if (is_utf16(*text)) return no_scene("the file's text is UTF-16; a scene is UTF-8", "save it as UTF-8");
    if (text->find('\0') != std::string::npos)
        return no_scene("this is a binary file; a scene is text (TOML)");
    return text;
}

}  // namespace candela
