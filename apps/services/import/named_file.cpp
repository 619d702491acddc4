#include "import/named_file.h"

#include <iconv.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstdint>
#include <system_error>
#include <vector>

import candela.util;

namespace fs = std::filesystem;

namespace importing {

namespace {

bool is_file(const fs::path& path) {
    std::error_code problem;
    return fs::is_regular_file(path, problem);
}

/// The name and its possible meanings if it comes from another machine.
std::vector<std::string> readings_of(std::string_view name) {
    std::vector<std::string> readings;
    const auto add = [&](std::string reading) {
        if (!reading.empty() && std::ranges::find(readings, reading) == readings.end())
            readings.push_back(std::move(reading));
    };
    add(std::string(name));
    if (name.size() > 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
    std::string turned(name);
    std::ranges::replace(turned, '\\', '/');
    while (turned.ends_with('/')) turned.pop_back();
    add(turned);
    add(turned.substr(turned.rfind('/') + 1));
    return readings;
}

bool are_same_but_for_capitals(std::string_view a, std::string_view b) {
    return std::ranges::equal(
        a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// Finds a file, ignoring the case of each part of the path.
std::optional<fs::path> find_in_other_case(const fs::path& folder, const fs::path& name) {
    fs::path found = name.is_absolute() ? fs::path("/") : folder;
    for (const fs::path& part : name.relative_path()) {
        std::error_code problem;
        if (fs::exists(found / part, problem)) {
            found /= part;
            continue;
        }
        constexpr std::size_t k_most = 100'000;
        const auto names = candela::names_in(found.empty() ? fs::path(".") : found, k_most);
        if (!names) return std::nullopt;
        const auto same = std::ranges::find_if(*names, [&](const std::string& other) {
            return are_same_but_for_capitals(other, part.string());
        });
        if (same == names->end()) return std::nullopt;
        found /= *same;
    }
    return is_file(found) ? std::optional(found) : std::nullopt;
}

/// Nothing if the text is invalid in that encoding.
std::optional<std::string> to_utf8(std::string_view text, const char* encoding) {
    ::iconv_t converter = ::iconv_open("UTF-8", encoding);  // NOLINT(misc-const-correctness): a pointer
    if (std::bit_cast<std::intptr_t>(converter) == -1) return std::nullopt;
    std::string from(text), to(4 * text.size() + 4, '\0');
    char *in = from.data(), *out = to.data();
    std::size_t left = from.size(), room = to.size();
    const std::size_t result = ::iconv(converter, &in, &left, &out, &room);
    ::iconv_close(converter);
    if (result == static_cast<std::size_t>(-1) || left > 0) return std::nullopt;
    to.resize(to.size() - room);
    return to;
}

std::optional<NamedFile> find_as_written(const fs::path& folder, std::string_view name) {
    const std::vector<std::string> readings = readings_of(name);
    for (const std::string& reading : readings)
        if (is_file(folder / reading)) return NamedFile{folder / reading};
    for (const std::string& reading : readings)
        if (const auto found = find_in_other_case(folder, reading)) return NamedFile{*found, true};
    return std::nullopt;
}

}  // namespace

std::optional<NamedFile> find_named(const fs::path& folder, std::string_view name) {
    if (name.empty() || name.find('\0') != std::string_view::npos) return std::nullopt;
    if (auto found = find_as_written(folder, name)) return found;
    if (!candela::first_invalid_byte(name)) return std::nullopt;
    // The encoding that yields an existing file is the right one.
    for (const char* const encoding : {"CP1252", "CP932", "GB18030", "CP949", "CP1251", "CP850"}) {
        const auto converted = to_utf8(name, encoding);
        if (!converted) continue;
        if (auto found = find_as_written(folder, *converted)) {
            found->is_renamed = true;
            return found;
        }
    }
    return std::nullopt;
}

}  // namespace importing
