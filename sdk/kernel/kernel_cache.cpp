#include "candela/kernel_language/kernel_cache.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

import candela.util;

namespace fs = std::filesystem;

namespace candela::kernel_language {

fs::path kernel_cache() {
    const auto variable = [](const char* name) {
        const char* const value = std::getenv(name);
        return fs::path(value != nullptr ? value : "");
    };
    if (const fs::path cache = variable("XDG_CACHE_HOME"); cache.is_absolute())
        return cache / "candela/kernels";
    if (const fs::path home = variable("HOME"); home.is_absolute()) return home / ".cache/candela/kernels";
    return fs::temp_directory_path() / fmt::format("candela-kernels-{}", ::geteuid());
}

ContentHash& ContentHash::add(std::string_view text) {
    for (const char c : text) value_ = (value_ ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    value_ = (value_ ^ 0xff) * 0x100000001b3;
    return *this;
}

ContentHash& ContentHash::add_headers(const fs::path& include) {
    for (const char* const folder : {"candela", "candela/kernel", "candela/plugin"}) {
        std::vector<std::string> names = names_in(include / folder).value_or(std::vector<std::string>());
        std::ranges::sort(names);
        for (const std::string& name : names)
            if (const auto text = read_text_file(include / folder / name)) add(name).add(*text);
    }
    return *this;
}

std::string ContentHash::text() const { return fmt::format("{:016x}", value_); }

bool is_own_folder(const fs::path& folder) {
    struct stat status{};
    return ::lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == ::geteuid() &&
           (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

std::error_code keep(const fs::path& made, const fs::path& kept) {
    fs::permissions(made, fs::perms::owner_all);  // see is_own_folder()
    std::error_code problem;
    fs::rename(made, kept, problem);
    return problem;
}

}  // namespace candela::kernel_language
