#include "candela/kernel_language/kernel_cache.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
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

namespace {

constexpr const char* k_checksum = "checksum";

bool is_own_folder(const fs::path& folder) {
    struct stat status{};
    return ::lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == ::geteuid() &&
           (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

std::string checksum(const fs::path& folder) {
    ContentHash hash;
    std::vector<std::string> names = names_in(folder).value_or(std::vector<std::string>());
    std::ranges::sort(names);
    for (const std::string& name : names) {
        if (name == k_checksum) continue;
        if (const auto text = read_text_file(folder / name)) hash.add(name).add(*text);
    }
    return hash.text();
}

}  // namespace

std::error_code keep(const fs::path& made, const fs::path& kept) {
    write_text_file(made / k_checksum, checksum(made));
    fs::permissions(made, fs::perms::owner_all);  // see is_own_folder()
    std::error_code problem;
    fs::rename(made, kept, problem);
    if (!problem || is_kept(kept)) return {};
    fs::rename(kept, made.parent_path() / "damaged", problem);
    fs::rename(made, kept, problem);
    // Another process may have been faster.
    return is_kept(kept) ? std::error_code() : problem;
}

bool is_kept(const fs::path& folder) {
    if (!is_own_folder(folder) || read_text_file(folder / k_checksum) != checksum(folder)) return false;
    std::error_code ignored;
    fs::last_write_time(folder, fs::file_time_type::clock::now(), ignored);
    return true;
}

void remove_unused(const fs::path& cache) {
    constexpr auto k_month = std::chrono::hours(24 * 30);
    std::error_code ignored;
    for (const std::string& name : names_in(cache).value_or(std::vector<std::string>())) {
        const fs::path folder = cache / name;
        if (!is_own_folder(folder)) continue;
        const auto used = fs::last_write_time(folder, ignored);
        if (!ignored && used + k_month < fs::file_time_type::clock::now()) fs::remove_all(folder, ignored);
    }
}

}  // namespace candela::kernel_language
