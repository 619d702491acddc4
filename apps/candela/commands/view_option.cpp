#include "commands/view_option.h"

#include <fmt/format.h>

#include <string>
#include <vector>

import candela.api;
import candela.util;

namespace po = boost::program_options;
using candela::Error;
using candela::ErrorCategory;

void add_view_options(CommandLine& line) {
    line.options()(
        "view", po::value<std::string>()->value_name("NAME"),
        "show the picture through this view of an OpenColorIO configuration instead of the scene's "
        "tone curve")("display", po::value<std::string>()->value_name("NAME"),
                      "the display whose view it is; default: the configuration's")(
        "color-config", po::value<std::string>()->value_name("FILE"),
        "the OpenColorIO configuration; default: the environment variable OCIO");
}

std::optional<ViewName> view_name_from(const CommandLine& line) {
    if (!line.has("view") && !line.has("display") && !line.has("color-config")) return std::nullopt;
    const auto text = [&](const char* option) {
        return line.has(option) ? line.get<std::string>(option) : std::string();
    };
    return ViewName{.config = text("color-config"), .display = text("display"), .view = text("view")};
}

std::vector<std::string> view_words_from(const CommandLine& line, const ColorView& view) {
    std::vector<std::string> words{"--color-config=" + view.config()};
    for (const char* const option : {"view", "display"})
        if (line.has(option)) words.push_back(fmt::format("--{}={}", option, line.get<std::string>(option)));
    return words;
}

std::unique_ptr<ColorView> view_from(const CommandLine& line, const candela::OutputFormat& format) {
    const std::optional<ViewName> name = view_name_from(line);
    if (!name) return nullptr;
    if (format.pixels == candela::PixelType::real)
        throw Error(
            ErrorCategory::bad_request,
            fmt::format("--view: files of type .{} have the intensities themselves; programs that open "
                        "them apply the view",
                        format.extension));
    return std::make_unique<ColorView>(*name);
}
