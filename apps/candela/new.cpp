// candela new: a scene to begin with.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iostream>
#include <string>
#include <string_view>
#include <system_error>

#include "command_line.h"
#include "reporting.h"
#include "starter.h"
#include "verbs.h"

import candela.files;

using candela::Error;
using candela::ErrorCategory;

namespace {

/// A word as a shell takes it.
std::string quoted(const std::string& word) {
    const auto is_plain = [](unsigned char c) {
        return std::isalnum(c) != 0 || c >= 0x80 ||
               std::string_view("._/-+,:@").find(static_cast<char>(c)) != std::string_view::npos;
    };
    if (!word.empty() && std::ranges::all_of(word, is_plain)) return word;
    std::string result = "'";
    for (const char c : word) {
        if (c == '\'') {
            result += "'\\''";
        } else {
            result += c;
        }
    }
    return result + "'";
}

}  // namespace

int run_new(const std::vector<std::string>& arguments) {
    CommandLine line(
        "candela new [FILE] [options]",
        "Writes a small commented scene to learn from and to edit: to FILE, by default scene.toml;\n"
        "- prints it.");
    line.positional("file", 1);
    line.options()("force", "replace an existing file");
    if (!line.parse(arguments)) return 0;

    const std::string file = line.has("file") ? line.all("file").front() : "scene.toml";
    if (file == "-") {
        std::cout << starter_scene();
        return 0;
    }
    std::error_code problem;
    if (!line.has("force") && std::filesystem::exists(std::filesystem::symlink_status(file, problem))) {
        throw Error(ErrorCategory::failure, fmt::format("'{}' is there already; --force replaces it", file));
    }
    candela::write_text_file(file, starter_scene(),
                             line.has("force") ? candela::Existing::replaced : candela::Existing::kept);
    say_afterwards([&] {
        return fmt::format("Wrote {}. Next, edit it and run: candela render {}\n", file, quoted(file));
    });
    return 0;
}
