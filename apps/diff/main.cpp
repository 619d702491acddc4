// candela-diff A B …: measures how two pictures differ. Run by `candela diff`.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "cli/outputs.h"
#include "cli/signals.h"
#include "compare/comparison.h"
#include "compare/perception.h"
#include "console/reporting.h"
#include "heat_map.h"
#include "image_file.h"

import candela.util;

namespace po = boost::program_options;
using candela::Error;
using candela::ErrorCategory;

namespace {

/// "12 levels, at x 3, y 4"
std::string maximum_text(const DifferenceStatistics& statistics) {
    if (statistics.maximum == 0) return "0 levels";
    return fmt::format("{:.6g} levels, first at x {}, y {}", statistics.maximum, statistics.x, statistics.y);
}

void print_text(const Image& a, const Comparison& comparison) {
    const Differences& differences = comparison.differences;
    const auto print = [](const char* name, const std::string& value) {
        std::cout << fmt::format("{:<19} {}\n", name, value);
    };
    const DifferenceStatistics& interior = differences.interior;
    const std::optional<double> psnr = interior.psnr();
    print("size", dimensions_text(a));
    print("pixels compared", fmt::to_string(interior.pixels));
    print("identical", fmt::format("{:.6g} %", 100 * interior.identical_share()));
    print("maximum difference", maximum_text(interior));
    print("mean difference", fmt::format("{:.6g} levels", interior.mean));
    print("RMSE", fmt::format("{:.6g} levels", interior.rmse));
    print("PSNR", psnr ? fmt::format("{:.2f} dB", *psnr) : "infinite");
    if (differences.edges) {
        print("edges", fmt::format("{} pixels", differences.edges->pixels));
        print("  maximum", maximum_text(*differences.edges));
        print("  mean", fmt::format("{:.6g} levels", differences.edges->mean));
    }
    print("perceptible",
          fmt::format("{} pixels, {:.6g} %{}", comparison.perceptible, 100 * comparison.perceptible_share(),
                      differences.edges ? ", edges among them" : ""));
}

/// The tolerance; infinity if none was given.
double tolerance_from(const CommandLine& line) {
    if (!line.has("tolerance")) return std::numeric_limits<double>::infinity();
    const auto tolerance = line.get<double>("tolerance");
    if (!(tolerance >= 0 && std::isfinite(tolerance)))
        throw Error(ErrorCategory::bad_request,
                    fmt::format("--tolerance is {}; expected 0 or more", tolerance));
    return tolerance;
}

void require_same_size(const std::string& a_name, const Image& a, const std::string& b_name, const Image& b) {
    if (a.width == b.width && a.height == b.height) return;
    throw Error(ErrorCategory::failure,
                fmt::format("the pictures differ in size: '{}' has {} pixels, '{}' has {}", a_name,
                            dimensions_text(a), b_name, dimensions_text(b)));
}

void write_ppm(const std::string& file, const Image& image, candela::Existing existing) {
    std::string text = fmt::format("P6\n{} {}\n255\n", image.width, image.height);
    text.reserve(text.size() + image.values.size());
    for (std::size_t i = 0; i < image.values.size(); ++i)
        text += static_cast<char>(std::lround(255 * std::clamp(image.normalized(i), 0.0f, 1.0f)));
    candela::write_text_file(file, text, existing);
}

int verdict(double tolerance, const DifferenceStatistics& statistics) {
    if (statistics.beyond == 0) return 0;
    return fail(
        ExitCode::verification_failed,
        fmt::format("{} pixel{} by more than {:.6g} levels; the largest difference is {}", statistics.beyond,
                    statistics.beyond == 1 ? " differs" : "s differ", tolerance, maximum_text(statistics)));
}

int run(const std::vector<std::string>& arguments) {
    CommandLine line(
        "candela diff A B [options]",
        "Report how two pictures of the same size differ, in levels (1/255) over all pixels and channels, "
        "and how many pixels differ visibly (Yee's metric). Reads any format that OpenImageIO or an image "
        "plugin "
        "supports. Alpha is ignored; grey counts as equal red, green and blue; floats are compared "
        "unchanged, times "
        "255.\n\nExit codes: 0 compared, 1 a picture cannot be read or written, or sizes differ, 2 wrong "
        "usage,\n"
        "4 beyond --tolerance.");
    line.positional("picture", 2);
    line.options()("output,o", po::value<std::string>()->value_name("FILE"),
                   "write a heat-map: black where nothing differs, white-hot at the largest difference")(
        "mask", po::value<std::string>()->value_name("FILE"),
        "a picture of the same size whose white pixels mark edges, to be counted separately")(
        "tolerance", po::value<double>()->value_name("N"),
        "exit with code 4 if a channel of a pixel away from edges differs by more than N levels")(
        "json", "print the statistics as JSON")("decoded", po::value<std::string>()->value_name("FILE"),
                                                "write picture B as an 8-bit PPM");
    add_no_clobber_option(line);
    add_plugin_options(line);
    if (!line.parse(arguments)) return 0;
    const std::vector<std::string> names = line.all("picture");
    if (names.size() != 2)
        throw Error(ErrorCategory::bad_request,
                    "candela diff needs two pictures: candela diff A B [options]");
    const double tolerance = tolerance_from(line);
    if (line.has("output")) require_heat_map_format(line.get<std::string>("output"));
    std::vector<std::filesystem::path> inputs(names.begin(), names.end());
    if (line.has("mask")) inputs.emplace_back(line.get<std::string>("mask"));
    const candela::Existing existing = existing_from(line);
    for (const char* const flag : {"output", "decoded"}) {
        if (!line.has(flag)) continue;
        require_free(line.get<std::string>(flag), existing);
        require_no_input(line.get<std::string>(flag), inputs, "the pictures that are compared",
                         fmt::format("give --{} another name", flag));
    }

    candela::Registry registry = registry_from(line);
    const Image a = read_image(names[0], registry), b = read_image(names[1], registry);
    if (line.has("decoded")) write_ppm(line.get<std::string>("decoded"), b, existing);
    require_same_size(names[0], a, names[1], b);
    std::optional<Image> mask;
    if (line.has("mask")) {
        const auto file = line.get<std::string>("mask");
        mask = read_image(file, registry);
        require_same_size(names[0], a, file, *mask);
    }
    Comparison comparison{.width = a.width,
                          .height = a.height,
                          .differences = compare(a, b, mask ? &*mask : nullptr, tolerance)};
    mask.reset();
    comparison.perceptible = perceptible_pixels(a, b);
    const Differences& differences = comparison.differences;
    if (line.has("output")) {
        const double maximum =
            std::max(differences.interior.maximum, differences.edges ? differences.edges->maximum : 0);
        write_heat_map(line.get<std::string>("output"), a, b, maximum, existing);
    }
    if (line.has("json")) {
        std::cout << to_json(comparison) << '\n';
    } else {
        print_text(a, comparison);
    }
    std::cout.flush();
    return verdict(tolerance, differences.interior);
}

}  // namespace

int main(int argc, char** argv) {
    prepare_for_signals();
    return run_and_report([&] { return run({argv + 1, argv + argc}); });
}
