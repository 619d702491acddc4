// candela compare: one scene with different models and values, side by side.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "aov/terms.h"
#include "cli/command_line.h"
#include "cli/commands.h"
#include "cli/output_format.h"
#include "cli/outputs.h"
#include "cli/scene_compilation.h"
#include "color_view/color_view.h"
#include "commands/luminance_option.h"
#include "commands/variants.h"
#include "commands/view_option.h"
#include "compare/contact_sheet.h"
#include "compare/differences.h"
#include "console/exit_code.h"
#include "console/reporting.h"
#include "console/terminal.h"
#include "json/json.h"
#include "render/darkness_diagnosis.h"

import candela.api;
import candela.render;
import candela.scene;

namespace po = boost::program_options;
using candela::Error;
using candela::ErrorCategory;

namespace {

constexpr std::size_t k_most_images = 256;

struct Pane {
    std::string label;
    std::vector<Variant> variants;
    candela::Film film;
    std::optional<DifferenceStatistics> difference{};  // from the first pane
};

/// The value of --columns, if given.
std::optional<int> columns_from(const CommandLine& line, std::size_t panes) {
    if (!line.has("columns")) return std::nullopt;
    const int columns = line.get<int>("columns");
    if (columns >= 1 && static_cast<std::size_t>(columns) <= panes) return columns;
    throw Error(ErrorCategory::bad_request,
                fmt::format("--columns is {}; expected 1 to {}, the number of pictures", columns, panes));
}

/// As many columns as the first axis has variants. A single axis is broken into rows so that the sheet is
/// about one and a half times as wide as it is high, with at least two pictures side by side.
int columns_for(const std::vector<Axis>& axes, std::size_t panes, const candela::Film& picture) {
    std::vector<std::size_t> sides;
    for (const Axis& axis : axes) {
        if (axis.size() > 1) sides.push_back(axis.size());
    }
    if (sides.size() == 2) return static_cast<int>(sides.front());
    constexpr double k_aspect = 1.5;
    const double ideal =
        std::sqrt(k_aspect * static_cast<double>(panes) * picture.height() / picture.width());
    return std::clamp(static_cast<int>(std::lround(ideal)), 2, static_cast<int>(panes));
}

/// The film's pixels, for a comparison.
Image image_of(const candela::Film& film) {
    const candela::ImageView view = film.view();
    Image picture;
    picture.width = view.width;
    picture.height = view.height;
    picture.is_float = view.pixels == candela::PixelType::real;
    constexpr float k_byte = Image::k_whole / 255;
    if (picture.is_float) picture.values.assign(view.reals.begin(), view.reals.end());
    for (const std::uint8_t byte : view.bytes) picture.values.push_back(k_byte * static_cast<float>(byte));
    return picture;
}

/// The largest difference among each pixel's channels; white stands for `maximum` levels.
candela::Film difference_film(const Image& a, const Image& b, double maximum, candela::PixelType pixels) {
    candela::Film film(a.width, a.height, pixels, candela::ColorEncoding::none);
    std::vector<float> grey(a.pixels());
    for (std::size_t i = 0; i < grey.size() && maximum > 0; ++i)
        grey[i] = static_cast<float>(largest_difference(a, b, i) / maximum);
    film.store(0, 0, a.width, a.height, {grey.data(), grey.data(), grey.data()}, a.width);
    return film;
}

/// Replaces every picture but the first with its difference from the first.
void show_differences(std::vector<Pane>& panes, candela::PixelType pixels) {
    const Image first = image_of(panes.front().film);
    std::vector<Image> others;
    double maximum = 0;
    for (std::size_t i = 1; i < panes.size(); ++i) {
        others.push_back(image_of(panes[i].film));
        panes[i].difference = compare(first, others.back(), nullptr, 0).interior;
        maximum = std::max(maximum, panes[i].difference->maximum);
    }
    for (std::size_t i = 1; i < panes.size(); ++i) {
        panes[i].film = difference_film(first, others[i - 1], maximum, pixels);
        panes[i].label += fmt::format(
            ": mean {:.2f}, max {:.1f}{}", panes[i].difference->mean, panes[i].difference->maximum,
            panes[i].difference->maximum == maximum && maximum > 0 ? " (white)" : "");
    }
}

std::string json_of(const std::vector<Pane>& panes, int columns) {
    Json all = Json::array();
    for (std::size_t i = 0; i < panes.size(); ++i) {
        Json settings = Json::object();
        for (const Variant& variant : panes[i].variants)
            settings[variant.option.starts_with("--") ? variant.option.substr(2) : variant.option] =
                variant.value;
        Json pane{{"column", i % static_cast<std::size_t>(columns)},
                  {"row", i / static_cast<std::size_t>(columns)},
                  {"settings", settings}};
        if (panes[i].difference) {
            pane["difference"] = {{"mean", panes[i].difference->mean},
                                  {"rmse", panes[i].difference->rmse},
                                  {"maximum", panes[i].difference->maximum}};
        }
        all.push_back(pane);
    }
    return json_text({{"pictures", all}}, 2);
}

bool has_several_terms(const std::vector<Axis>& axes) {
    return std::ranges::any_of(
        axes, [](const Axis& axis) { return axis.size() > 1 && axis.front().option == "--terms"; });
}

/// The single term that a word of --terms names.
NamedTerm one_term(const std::string& word, const candela::Scene& scene) {
    std::vector<NamedTerm> terms = terms_from({word}, scene, "--terms");
    if (terms.size() == 1) return terms.front();
    throw Error(ErrorCategory::bad_request,
                fmt::format("--terms: '{}' is {}; each picture shows one term, such as {}", word,
                            terms.empty() ? "not a term of this scene" : "several terms",
                            terms.empty() ? "diffuse" : terms.front().name));
}

/// Renders one scene repeatedly.
class PaneRenderer {
  public:
    PaneRenderer(const CommandLine& line, const std::string& output, candela::Registry& registry,
                 candela::PixelType pixels, ColorView* view)
        : request_(scene_request_from(line, registry)),
          output_(output),
          registry_(registry),
          pixels_(pixels),
          view_(view),
          luminance_(luminance_display_from(line)) {
        luminance_.has_legend = false;
        request_.reflection.reset();
        request_.shading.reset();
        if (!request_.ask) return;
        // One answer applies to all pictures.
        request_.ask = [ask = request_.ask, answers = std::make_shared<std::map<std::string, bool>>()](
                           const std::string& question) {
            const auto known = answers->find(question);
            return known != answers->end() ? known->second : (*answers)[question] = ask(question);
        };
    }

    /// The picture with these variants, or nothing after reporting an error; exit_code() then returns the
    /// exit code. Diagnostics that several pictures share are reported once.
    std::optional<candela::Film> film(const std::vector<Variant>& variants, const std::string& label) {
        candela::Diagnostics diagnostics;
        const auto draft = candela::draft_scene(varied(request_, variants), registry_, diagnostics);
        if (draft) require_no_scene_file(output_, candela::input_files(*draft), "the sheet");
        const auto compiled = draft ? compile_scene(*draft, registry_, diagnostics) : std::nullopt;
        if (has_news(diagnostics) || !compiled) report(diagnostics);
        if (!compiled) {
            exit_code_ =
                fail(exit_code_of(diagnostics),
                     fmt::format("no sheet written: the errors above are in the picture '{}'", label));
            return std::nullopt;
        }
        encoding_ = compiled->image.color_management;
        const auto term = std::ranges::find(variants, "--terms", &Variant::option);
        if (term != variants.end() && term->value != "picture") {
            const NamedTerm named = one_term(term->value, draft->scene);
            shows_luminance_ =
                shows_luminance_ || (is_luminance(named) && pixels_ == candela::PixelType::byte);
            return TermRenderer(*compiled, 0).image(named, pixels_, luminance_);
        }
        candela::Film film(compiled->image.width, compiled->image.height,
                           view_ != nullptr ? candela::PixelType::real : pixels_,
                           candela::display_of(*compiled));
        const auto statistics = candela::render(*compiled, film, {});
        const std::string darkness = candela::darkness_diagnosis(*compiled, film, statistics);
        if (!darkness.empty()) warn(fmt::format("nothing in the picture '{}' is lit: {}", label, darkness));
        if (view_ == nullptr) return film;
        return view_->applied(film, candela::exposure_factor(compiled->observer.exposure));
    }

    int exit_code() const { return exit_code_; }
    candela::ColorEncoding encoding() const { return encoding_; }
    /// Of all pictures that show luminances in false colours.
    std::optional<LuminanceScale> luminance_scale() const {
        return shows_luminance_ ? luminance_.scale : std::nullopt;
    }

  private:
    bool has_news(const candela::Diagnostics& diagnostics) {
        bool is_news = false;
        for (const candela::Diagnostic& one : diagnostics.sorted())
            is_news = said_.insert(one.message).second || is_news;
        return is_news;
    }

    candela::SceneRequest request_;
    const std::string& output_;
    candela::Registry& registry_;
    candela::PixelType pixels_;
    ColorView* view_;
    LuminanceDisplay luminance_;
    bool shows_luminance_ = false;
    candela::ColorEncoding encoding_ = candela::ColorEncoding::none;
    std::set<std::string> said_;
    int exit_code_ = 0;
};

}  // namespace

int run_compare(const std::vector<std::string>& arguments) {
    CommandLine line(
        "candela compare [SCENE...] [options]",
        "Render a scene with different models or values, and put the labelled pictures on one sheet: candela "
        "compare scene.toml --reflection lambert,phong,ggx --shading flat,phong. Give one or two of "
        "--reflection, --shading, --vary and --terms several values, separated by commas. A model may be a "
        "kernel file.");
    line.options()("output,o", po::value<std::string>()->value_name("FILE")->default_value("comparison.png"),
                   "the sheet; its extension selects the format");
    add_variant_options(line);
    add_luminance_option(line);
    line.options()("difference", "show how the other pictures differ from the first, in levels (1/255)")(
        "columns", po::value<int>()->value_name("N"), "how many pictures to put side by side")(
        "json", "print the sheet's layout and the differences as JSON");
    add_scene_options(line);
    add_view_options(line);
    add_format_option(line);
    add_no_clobber_option(line);
    if (!line.parse(arguments)) return 0;

    const std::vector<Axis> axes = axes_from(line);
    const auto all = combinations(axes);
    if (all.size() < 2) {
        throw Error(ErrorCategory::bad_request,
                    "nothing to compare; name several models or values, as in --reflection phong,ggx");
    }
    if (all.size() > k_most_images) {
        throw Error(
            ErrorCategory::bad_request,
            fmt::format("the sheet would have {} pictures; the maximum is {}", all.size(), k_most_images));
    }
    if (line.has("difference") && has_several_terms(axes))
        throw Error(ErrorCategory::bad_request,
                    "--difference compares pictures of the same term; give --terms only one");
    const auto output = line.get<std::string>("output");
    require_no_default_link(line, "output", output);
    if (output == "-" && line.has("json"))
        throw Error(ErrorCategory::bad_request, "-o - and --json both use standard output; choose one");
    require_no_terminal(output);
    const candela::Existing existing = existing_from(line);
    require_free(output, existing);
    const auto wanted_columns = columns_from(line, all.size());
    candela::Registry registry = registry_from(line);
    const candela::OutputFormat format = output_format_from(line, output, registry);

    const std::unique_ptr<ColorView> view = view_from(line, format);
    PaneRenderer renderer(line, output, registry, format.pixels, view.get());
    if (view) view->require();
    std::vector<Pane> panes;
    {
        ProgressBar bar("rendering", !is_quiet());
        for (const std::vector<Variant>& variants : all) {
            const std::string label = label_of(axes, variants);
            auto film = renderer.film(variants, label);
            if (!film) return renderer.exit_code();
            if (!panes.empty() &&
                (film->width() != panes[0].film.width() || film->height() != panes[0].film.height()))
                throw Error(ErrorCategory::bad_request,
                            "the pictures differ in size; a sheet needs pictures of one size");
            panes.push_back({label, variants, *std::move(film)});
            bar.update(panes.size(), all.size());
        }
    }
    if (line.has("difference")) show_differences(panes, format.pixels);
    const int columns =
        wanted_columns ? *wanted_columns : columns_for(axes, panes.size(), panes.front().film);
    const int rows = (static_cast<int>(panes.size()) + columns - 1) / columns;
    ContactSheet sheet({columns, rows, panes.front().film.width(), panes.front().film.height()},
                       format.pixels, renderer.encoding());
    for (std::size_t i = 0; i < panes.size(); ++i)
        sheet.put(static_cast<int>(i), panes[i].film, panes[i].label);
    const auto scale = renderer.luminance_scale();
    candela::write_image(scale ? with_legend(sheet.film(), *scale) : sheet.film(), format, output, registry,
                         existing);
    if (line.has("json")) std::cout << json_of(panes, columns) << '\n';
    say_afterwards([&] {
        return fmt::format("{}: {} pictures of {} x {}\n", output == "-" ? "sheet" : output, panes.size(),
                           panes.front().film.width(), panes.front().film.height());
    });
    return 0;
}
