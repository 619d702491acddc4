// candela plot: plots the lobes of reflection models and the light emitted by lights.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "cli/command_line.h"
#include "cli/commands.h"
#include "cli/outputs.h"
#include "console/reporting.h"
#include "plot/light_curves.h"
#include "plot/lobe.h"
#include "plot/lobe_text.h"

import candela.plugins;
import candela.util;

namespace po = boost::program_options;
using candela::Error;
using candela::ErrorCategory;

namespace {

double incidence_from(const CommandLine& line) {
    const auto degrees = line.get<double>("incidence");
    if (!(degrees >= 0 && degrees < 90)) {
        throw Error(ErrorCategory::bad_request,
                    fmt::format("--incidence is {}; expected at least 0 and less than 90 degrees", degrees));
    }
    return degrees;
}

std::vector<NamedModel> models_from(const CommandLine& line, candela::Registry& registry) {
    std::vector<NamedModel> models;
    for (const std::string& text : line.all("model")) models.push_back(model_from(text, registry));
    if (models.empty()) {
        throw Error(
            ErrorCategory::bad_request,
            "candela plot needs a model, as in candela plot reflection/phong:shininess=20 -o lobe.svg");
    }
    for (const NamedModel& model : models) {
        if (model.kind != models.front().kind)
            throw Error(
                ErrorCategory::bad_request,
                fmt::format("{} and {} cannot share a diagram; expected either reflection models or lights",
                            models.front().label(), model.label()));
    }
    return models;
}

/// Sets a value in all models that have the parameter and do not set it themselves.
void set_where_known(std::vector<NamedModel>& models, const std::string& text, candela::Registry& registry) {
    const auto value = value_from(text);
    std::vector<std::string> known;
    bool is_known = false;
    for (NamedModel& model : models) {
        for (const candela::Parameter& parameter :
             registry.require(model.kind, model.name).manifest.parameters) {
            known.push_back(parameter.name);
            if (parameter.name != value.first) continue;
            is_known = true;
            const auto is_same = [&](const auto& own) { return own.first == value.first; };
            if (std::ranges::none_of(model.values, is_same)) model.values.push_back(value);
        }
    }
    if (is_known) return;
    const std::string meant = candela::suggestion(value.first, known);
    throw Error(ErrorCategory::bad_request, fmt::format("--set {}: none of the models has this parameter{}{}",
                                                        text, meant.empty() ? "" : "; ", meant));
}

/// Sets every model but the first to the value of the parameter that brings it nearest to the first.
void match_to_first(std::vector<NamedModel>& models, const std::string& parameter, double incidence,
                    candela::Registry& registry) {
    if (models.size() < 2) {
        throw Error(ErrorCategory::bad_request,
                    "--match needs a reference model, then one or more models to match to it");
    }
    const Lobe target = lobe_of(models.front(), incidence, registry);
    for (std::size_t i = 1; i < models.size(); ++i) {
        const Match match = match_lobe(target, models[i], parameter, incidence, registry);
        std::erase_if(models[i].values, [&](const auto& value) { return value.first == parameter; });
        models[i].values.emplace_back(parameter, fmt::format("{:.4g}", match.value));
        std::cout << candela::printable(fmt::format(
                         "{} is nearest to {}; the difference is {:.2g} % of the peak (root mean square)",
                         models[i].label(), target.label, 100 * match.error))
                  << '\n';
    }
}

/// The file of a diagram.
struct DiagramFile {
    std::string name;  // empty: the table is written to standard output
    std::string extension;
    candela::Existing existing;
};

void write(const DiagramFile& output, const std::function<std::string()>& svg,
           const std::function<std::string()>& csv) {
    if (output.name.empty()) {
        std::cout << csv();
    } else {
        candela::write_text_file(output.name, output.extension == "svg" ? svg() : csv(), output.existing);
    }
}

/// A model may read a file, such as one of measured values.
void require_no_value(const std::string& output, const std::vector<NamedModel>& models) {
    std::vector<std::filesystem::path> files;
    for (const NamedModel& model : models) {
        for (const auto& [name, value] : model.values) {
            const bool is_quoted = value.size() > 1 && value.front() == '"' && value.back() == '"';
            files.emplace_back(is_quoted ? value.substr(1, value.size() - 2) : value);
        }
    }
    require_no_input(output, files, "the files that the models read", "give the diagram another name");
}

void plot_lights(const CommandLine& line, const std::vector<NamedModel>& models, const DiagramFile& output,
                 candela::Registry& registry) {
    for (const char* const option : {"match", "log"}) {
        if (line.has(option))
            throw Error(ErrorCategory::bad_request,
                        fmt::format("--{} applies to reflection models, not to lights", option));
    }
    std::vector<LightCurves> lights;
    for (const NamedModel& model : models) lights.push_back(light_curves_of(model, registry));
    write(output, [&] { return light_curves_svg(lights); }, [&] { return light_curves_csv(lights); });
}

}  // namespace

int run_plot(const std::vector<std::string>& arguments) {
    CommandLine line(
        "candela plot MODEL... [options]",
        "Plot how reflection models reflect light from one direction, as a polar diagram in the plane of "
        "incidence (SVG) or a table (CSV). MODEL is reflection/ggx, a kernel file or, with values of "
        "its parameters, reflection/ggx:roughness=0.3,ior=1.8. Several models share one diagram. For lights "
        "(light/spot), plot the emitted light over the angle with their axis and over the distance.");
    line.positional("model", -1);
    line.options()("output,o", po::value<std::string>()->value_name("FILE"),
                   "the diagram, .svg or .csv; default: print the table")(
        "set", po::value<std::vector<std::string>>()->value_name("NAME=VALUE"),
        "set a parameter of all models that have it; can be repeated")(
        "incidence", po::value<double>()->value_name("DEGREES")->default_value(45, "45"),
        "the angle between the light and the surface's normal")(
        "log", "use a logarithmic radius, over four decades")(
        "match", po::value<std::string>()->value_name("NAME"),
        "find the value of this parameter that brings each model nearest to the first");
    add_no_clobber_option(line);
    add_plugin_options(line);
    if (!line.parse(arguments)) return 0;

    const std::string file = line.has("output") ? line.get<std::string>("output") : "";
    const DiagramFile output{file, candela::extension_of(file), existing_from(line)};
    if (!file.empty() && output.extension != "svg" && output.extension != "csv") {
        throw Error(ErrorCategory::bad_request,
                    fmt::format("'{}' is neither .svg nor .csv; expected one of these", file));
    }
    require_free(file, output.existing);
    const double incidence = incidence_from(line);
    candela::Registry registry = registry_from(line);
    std::vector<NamedModel> models = models_from(line, registry);
    for (const std::string& value : line.all("set")) set_where_known(models, value, registry);
    require_no_value(file, models);
    if (models.front().kind == candela::PluginKind::light) {
        plot_lights(line, models, output, registry);
        return 0;
    }
    if (line.has("match")) match_to_first(models, line.get<std::string>("match"), incidence, registry);
    if (line.has("match") && file.empty()) return 0;
    std::vector<Lobe> lobes;
    for (const NamedModel& model : models) lobes.push_back(lobe_of(model, incidence, registry));
    const auto scale = line.has("log") ? RadialScale::logarithmic : RadialScale::linear;
    write(output, [&] { return lobes_svg(lobes, incidence, scale); }, [&] { return lobes_csv(lobes); });
    return 0;
}
