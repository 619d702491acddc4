module;

#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

module candela.scene;

import candela.util;

namespace candela {

std::string file_suggestion(const std::filesystem::path& missing) {
    namespace fs = std::filesystem;
    constexpr std::size_t k_most = 10'000;  // a folder may contain any number
    const fs::path folder = missing.has_parent_path() ? missing.parent_path() : fs::path(".");
    std::error_code problem;
    if (!fs::is_directory(folder, problem))
        return fmt::format("there is no folder '{}' either", folder.string());
    const std::vector<std::string> names = names_in(folder, k_most).value_or(std::vector<std::string>());
    return suggestion(missing.filename().string(), names, (missing.parent_path() / "").string());
}

}  // namespace candela
