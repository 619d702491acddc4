module;

#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

module candela.toml;

import candela.diagnostics;
import candela.text;

namespace candela {

std::string file_suggestion(const std::filesystem::path& missing) {
    namespace fs = std::filesystem;
    constexpr std::size_t k_most = 10'000;  // a folder may contain any number
    const fs::path folder = missing.has_parent_path() ? missing.parent_path() : fs::path(".");
    std::error_code problem;
    if (!fs::is_directory(folder, problem))
        return fmt::format("there is no folder '{}' either", folder.string());
    std::vector<std::string> names;
    for (fs::directory_iterator entry(folder, problem), end;
         !problem && entry != end && names.size() < k_most; entry.increment(problem)) {
        names.push_back(entry->path().filename().string());
    }
    return suggestion(missing.filename().string(), names, (missing.parent_path() / "").string());
}

}  // namespace candela
