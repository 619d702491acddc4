#include "cli/usual_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

import candela.util;

namespace {

struct UsualOption {
    std::string_view given;
    std::string_view option;  // required in the verb
    std::string_view advice;  // empty: the option itself
};

constexpr std::string_view k_size = "use --width 800 --height 600";

constexpr auto k_usual_options = std::to_array<UsualOption>({
    {"--size", "--width", k_size},
    {"--resolution", "--width", k_size},
    {"--res", "--width", k_size},
    {"--dimensions", "--width", k_size},
    {"--geometry", "--width", k_size},
    {"-s", "--width", k_size},
    {"-r", "--width", k_size},
    {"-w", "--width", ""},
    {"-W", "--width", ""},
    {"-x", "--width", ""},
    {"-H", "--height", ""},
    {"-y", "--height", ""},
    {"--samples-per-pixel", "--samples", ""},
    {"--spp", "--samples", ""},
    {"--aa", "--samples", ""},
    {"--msaa", "--samples", ""},
    {"--antialiasing", "--samples", ""},
    {"-n", "--samples", ""},
    {"--out", "--output", ""},
    {"--file", "--output", ""},
    {"--picture", "--output", ""},
    {"--image", "--output", ""},
    {"-O", "--output", ""},
    {"-f", "--output", "the format follows the extension of the name after -o"},
    {"--format", "--output", "the format follows the extension of the name after -o"},
    {"--quality", "--format-set", "use --format-set quality=80"},
    {"--compression", "--format-set", "use --format-set compression=9"},
    {"--overwrite", "--force", ""},
    {"-y", "--force", ""},
    {"-f", "--force", ""},
    {"--jobs", "--threads", ""},
    {"-j", "--threads", ""},
    {"-t", "--threads", ""},
    {"--scene", "--set", "give only the scene's name: scene.toml"},
    {"--input", "--set", "give only the scene's name: scene.toml"},
    {"-i", "--set", "give only the scene's name: scene.toml"},
    {"--define", "--set", ""},
    {"-D", "--set", ""},
    {"--model", "--reflection", "use --reflection NAME or --shading NAME"},
    {"--material", "--reflection", "use --set object.NAME.material.ks=0.5"},
    {"--color", "--set", "use --set object.NAME.color=[255,0,0]"},
    {"--background", "--set", "use --set image.background=[255,255,255]"},
    {"--camera", "--set", "use --set observer.position=[0,1,4]"},
    {"--fov", "--set", "use --set observer.fov=40"},
    {"--silent", "--quiet", ""},
    {"-v", "--verbose", ""},
    {"--yes", "--defaults", ""},
});

}  // namespace

std::string suggested_option(const std::string& given, const std::vector<std::string>& known) {
    const auto usual = std::ranges::find_if(k_usual_options, [&](const UsualOption& each) {
        return each.given == given && std::ranges::find(known, each.option) != known.end();
    });
    if (usual == k_usual_options.end()) return candela::suggestion(given, known);
    return usual->advice.empty() ? fmt::format("did you mean '{}'?", usual->option)
                                 : std::string(usual->advice);
}

bool means_height(const std::vector<std::string>& arguments) {
    const auto is_number = [](std::string_view text) {
        return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
    };
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string_view word = arguments[i];
        if (!word.starts_with("-h")) continue;
        if (is_number(word.substr(2))) return true;
        if (word == "-h" && i + 1 < arguments.size() && is_number(arguments[i + 1])) return true;
    }
    return false;
}
