module;

#include <dirent.h>

#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

module candela.util;

namespace candela {

std::filesystem::path canonical_path(const std::filesystem::path& path) {
    std::error_code problem;
    const std::filesystem::path canonical = std::filesystem::weakly_canonical(path, problem);
    if (problem == std::errc::not_enough_memory) throw std::bad_alloc();
    return problem ? path : canonical;
}

std::optional<std::vector<std::string>> names_in(const std::filesystem::path& folder, std::size_t most) {
    constexpr auto k_close = [](DIR* directory) { ::closedir(directory); };
    const std::unique_ptr<DIR, decltype(k_close)> directory(::opendir(folder.c_str()), k_close);
    if (directory == nullptr) return std::nullopt;
    std::vector<std::string> names;
    while (names.size() < most) {
        errno = 0;
        const dirent* const entry = ::readdir(directory.get());
        if (entry == nullptr && errno != 0) return std::nullopt;
        if (entry == nullptr) break;
        const std::string_view name = static_cast<const char*>(entry->d_name);
        if (name != "." && name != "..") names.emplace_back(name);
    }
    return names;
}

}  // namespace candela
