// candela plugin new: a project for a plugin, from the installed template.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "command_line.h"
#include "helper.h"
#include "output_folder.h"
#include "plugin.h"
#include "reporting.h"

import candela.files;
import candela.text;

namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

namespace {

std::string replaced(std::string text, const std::map<std::string, std::string>& values) {
    for (const auto& [from, to] : values) {
        for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
            text.replace(at, from.size(), to);
    }
    return text;
}

/// "my-model" as my_model, MyModel and My model.
std::map<std::string, std::string> names_of(const std::string& name) {
    std::string ident, type, title;
    bool begins_word = true;
    for (const char c : name) {
        const char upper = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
        ident += c == '-' ? '_' : c;
        if (c != '-') type += begins_word ? upper : c;
        title += c == '-' ? ' ' : (title.empty() ? upper : c);
        begins_word = c == '-';
    }
    return {{"@NAME@", name}, {"@IDENT@", ident}, {"@TYPE@", type}, {"@TITLE@", title}};
}

void check_name(const std::string& name) {
    const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
    const auto is_allowed = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '-'; };
    bool good = !name.empty() && is_letter(name.front()) && name.back() != '-' &&
                name.find("--") == std::string::npos;
    for (const char c : name) good = good && is_allowed(c);
    if (!good) {
        throw Error(ErrorCategory::bad_request,
                    fmt::format("'{}' cannot be a plugin's name: lower-case letters, digits "
                                "and single hyphens, a letter first",
                                name));
    }
}

}  // namespace

int run_plugin_new(const std::vector<std::string>& arguments) {
    CommandLine line(
        "candela plugin new KIND NAME [DIR]",
        "Creates a plugin project: source, kernel where the kind has one, CMakeLists.txt, test and README,\n"
        "in DIR (or NAME). KIND is light, reflection, shading, shape, image or target. It builds and passes\n"
        "its tests as it stands.");
    line.positional("arguments", 3);
    if (!line.parse(arguments)) return 0;
    const std::vector<std::string> words = line.all("arguments");
    if (words.size() < 2)
        throw Error(ErrorCategory::bad_request,
                    "candela plugin new needs a kind and a name, such as: reflection cel");
    const std::vector<std::string> kinds{"light", "reflection", "shading", "shape", "image", "target"};
    if (std::ranges::find(kinds, words[0]) == kinds.end()) {
        const std::string meant = candela::suggestion(words[0], kinds);
        throw Error(ErrorCategory::bad_request,
                    fmt::format("there is no template for '{}'{} (kinds: {})", words[0],
                                meant.empty() ? "" : "; " + meant, fmt::join(kinds, ", ")));
    }
    check_name(words[1]);
    const fs::path target = words.size() > 2 ? words[2] : words[1];
    const fs::path source = beside_command("share/candela/templates") / words[0];
    if (!fs::is_directory(source))
        throw Error(ErrorCategory::failure,
                    fmt::format("the templates are not installed: there is no '{}' (package candela-dev)",
                                source.string()));
    if (fs::exists(target) && !(fs::is_directory(target) && fs::is_empty(target)))
        throw Error(ErrorCategory::failure, fmt::format("'{}' is already there", target.string()));
    const auto values = names_of(words[1]);
    OutputFolder folder(target);
    const auto templates = candela::names_in(source);
    if (!templates)
        throw Error(ErrorCategory::failure, fmt::format("the folder '{}' cannot be read", source.string()));
    for (const std::string& name : *templates) {
        const auto read = candela::read_text_file(source / name);
        if (!read)
            throw Error(ErrorCategory::failure, fmt::format("'{}' cannot be read", (source / name).string()));
        folder.write(replaced(name, values), replaced(*read, values));
    }
    folder.finish();
    candela::Registry registry(candela::plugin_search_path({}));
    const auto kind = candela::plugin_kind_named(words[0]);
    if (const auto* const hidden = kind ? registry.find(*kind, words[1]) : nullptr)
        warn(fmt::format(
            "there is a {} plugin '{}' already ({}); wherever the new one is found first, it hides that",
            words[0], words[1], hidden->library.string()));
    std::cout << fmt::format(
        "Made {0}. Next:\n  cd {0}\n  cmake -B build -DCMAKE_BUILD_TYPE=Release\n"
        "  cmake --build build && ctest --test-dir build\n",
        target.string());
    return 0;
}
