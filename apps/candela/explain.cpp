// candela explain: how a pixel gets its colour.
#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "command_line.h"
#include "compiling.h"
#include "exit_code.h"
#include "explanation.h"
#include "reporting.h"
#include "verbs.h"

import candela.render;
import candela.text;

namespace po = boost::program_options;
namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

namespace {

struct Pixel {
    int x = 0, y = 0;
};

std::optional<Pixel> pixel_from(std::string_view text) {
    Pixel pixel;
    const char* const begin = text.data();
    const char* const end = begin + text.size();
    const auto x = std::from_chars(begin, end, pixel.x);
    if (x.ec != std::errc{} || x.ptr == end || *x.ptr != ',') return std::nullopt;
    const auto y = std::from_chars(x.ptr + 1, end, pixel.y);
    if (y.ec != std::errc{} || y.ptr != end) return std::nullopt;
    return pixel;
}

}  // namespace

int run_explain(const std::vector<std::string>& arguments) {
    CommandLine line(
        "candela explain [SCENE...] --pixel X,Y [options]",
        "Explains a pixel of a scene's picture: which triangle is seen there, N and V, each light's L, R "
        "and\n"
        "H, what arrives and what is reflected, every value that the models' formulas name on the way, the\n"
        "sum, its encoding, and the byte. Without a scene: the default scene.");
    line.options()("pixel", po::value<std::string>()->value_name("X,Y"),
                   "the pixel, counted from the top left one, 0,0");
    add_scene_options(line);
    line.options()("json", "print the explanation as JSON")(
        "keep", po::value<std::string>()->value_name("FOLDER"),
        "keep the compiled kernels there, for the next pixels");
    if (!line.parse(arguments)) return 0;
    if (!line.has("pixel"))
        throw Error(ErrorCategory::bad_request, "candela explain needs a pixel: --pixel X,Y");
    const auto written = line.get<std::string>("pixel");
    const auto pixel = pixel_from(written);
    if (!pixel) {
        throw Error(ErrorCategory::bad_request,
                    fmt::format("--pixel is '{}'; it is two whole numbers, as in --pixel 320,240", written));
    }

    candela::Registry registry = registry_from(line);
    candela::Diagnostics diagnostics;
    const auto draft = candela::draft_scene(scene_request_from(line), registry, diagnostics);
    const auto compiled = draft ? compile_scene(*draft, registry, diagnostics) : std::nullopt;
    report(diagnostics);
    if (!compiled) return static_cast<int>(exit_code_of(diagnostics));
    const candela::ImageSettings& image = compiled->image;
    if (pixel->x < 0 || pixel->y < 0 || pixel->x >= image.width || pixel->y >= image.height) {
        throw Error(ErrorCategory::bad_request,
                    fmt::format("--pixel is {}; the picture's pixels are 0,0 to {},{}", written,
                                image.width - 1, image.height - 1));
    }
    const fs::path kept = line.has("keep") ? line.get<std::string>("keep") : "";
    if (!kept.empty() && !fs::is_directory(kept)) {
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' is no folder, in which compiled kernels could be kept", kept.string()));
    }
    const Explanation explanation(draft->scene, *compiled, registry, pixel->x, pixel->y, kept);
    if (line.has("json")) {
        std::cout << candela::printable_json(explanation_json(explanation)) << '\n';
    } else {
        std::cout << explanation_text(explanation);
    }
    return 0;
}
