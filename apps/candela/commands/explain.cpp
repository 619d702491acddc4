// candela explain: shows how a pixel gets its colour.
#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command_line.h"
#include "cli/commands.h"
#include "cli/scene_compilation.h"
#include "console/exit_code.h"
#include "console/reporting.h"
#include "inspect/explanation.h"
#include "json/json.h"

import candela.render;

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

Error no_pixel(const std::string& written) {
    return {ErrorCategory::bad_request,
            fmt::format("--pixel is '{}'; expected two whole numbers, as in --pixel 320,240", written)};
}

/// Throws candela::Error (bad_request) if the pixel is not in the picture.
Pixel pixel_of(const std::string& written, const candela::ImageSettings& image) {
    const auto pixel = pixel_from(written);
    if (!pixel) throw no_pixel(written);
    if (pixel->x < 0 || pixel->y < 0 || pixel->x >= image.width || pixel->y >= image.height) {
        throw Error(ErrorCategory::bad_request,
                    fmt::format("--pixel is {}; expected 0,0 to {},{}, the picture's pixels", written,
                                image.width - 1, image.height - 1));
    }
    return *pixel;
}

/// Explains the pixels requested on standard input, one per line. An invalid line does not end it.
template <class Explain>
int explain_all(const candela::ImageSettings& image, bool is_json, const Explain& explain) {
    std::cin.exceptions(std::ios::badbit);
    int code = 0;
    for (std::string line; std::getline(std::cin, line);) {
        try {
            explain(pixel_of(line, image));
        } catch (const Error& problem) {
            code = static_cast<int>(exit_code_of(problem.category()));
            if (is_json) {
                std::cout << json_text({{"error", problem.what()}}) << '\n';
            } else {
                fail(exit_code_of(problem.category()), problem.what());
            }
        }
        std::cout << std::flush;  // the reader may be waiting
    }
    return code;
}

}  // namespace

int run_explain(const std::vector<std::string>& arguments) {
    CommandLine line(
        "candela explain [SCENE...] --pixel X,Y [options]",
        "Explain a pixel of a scene's picture: which triangle is visible there, N and V, each light's L, R "
        "and H, the arriving and the reflected light, every value that the models' formulas name on the way, "
        "the sum, its encoding, and the byte. Without a scene, use the default scene.");
    line.options()(
        "pixel", po::value<std::string>()->value_name("X,Y"),
        "the pixel to explain, counted from the top left one, 0,0; -: read pixels from standard input, one "
        "per line, until it ends");
    add_scene_options(line);
    add_frame_option(line);
    line.options()("json", "print the explanation as JSON")(
        "keep", po::value<std::string>()->value_name("FOLDER"),
        "keep the compiled kernels there for the next pixels");
    if (!line.parse(arguments)) return 0;
    if (!line.has("pixel"))
        throw Error(ErrorCategory::bad_request, "candela explain needs a pixel: --pixel X,Y");
    const auto written = line.get<std::string>("pixel");
    const bool is_for_many = written == "-";
    if (!is_for_many && !pixel_from(written)) throw no_pixel(written);

    candela::Registry registry = registry_from(line);
    candela::Diagnostics diagnostics;
    const auto draft = candela::draft_scene(scene_request_from(line, registry), registry, diagnostics);
    const auto compiled = draft ? compile_scene(*draft, registry, diagnostics) : std::nullopt;
    report(diagnostics);
    if (!compiled) return static_cast<int>(exit_code_of(diagnostics));
    const fs::path kept = line.has("keep") ? line.get<std::string>("keep") : "";
    if (!kept.empty() && !fs::is_directory(kept)) {
        throw Error(ErrorCategory::failure, fmt::format("--keep '{}' is not a folder", kept.string()));
    }
    KernelRunner kernels(plugins_explained_in(draft->scene, registry), kept);
    const bool is_json = line.has("json");
    const auto explain = [&](Pixel pixel) {
        const Explanation explanation(draft->scene, *compiled, registry, pixel.x, pixel.y, kernels);
        if (!is_json) {
            std::cout << explanation_text(explanation);
        } else {
            const auto text =
                explanation_json(explanation, is_for_many ? JsonLayout::one_line : JsonLayout::indented);
            std::cout << text << '\n';
        }
    };
    if (is_for_many) {
        kernels.prepare();  // before the first request
        return explain_all(compiled->image, is_json, explain);
    }
    explain(pixel_of(written, compiled->image));
    return 0;
}
