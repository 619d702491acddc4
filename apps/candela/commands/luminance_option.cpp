#include "commands/luminance_option.h"

#include <fmt/format.h>

namespace po = boost::program_options;

namespace {

constexpr const char* k_option = "luminance-scale";

}  // namespace

void add_luminance_option(CommandLine& line) {
    line.options()(
        k_option, po::value<std::string>()->value_name("LOW,HIGH"),
        "the luminances at both ends of the false colours of --terms luminance, in cd/m²; default: "
        "powers of ten around those of the picture");
}

LuminanceDisplay luminance_display_from(const CommandLine& line) {
    LuminanceDisplay display;
    if (line.has(k_option))
        display.scale = luminance_scale_from(line.get<std::string>(k_option), fmt::format("--{}", k_option));
    return display;
}
