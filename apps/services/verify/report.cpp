#include "verify/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "candela/target/literals.h"
#include "json/json.h"

namespace verify {

namespace {

double percent(std::size_t part, std::size_t whole) {
    return whole == 0 ? 0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

/// All pixels: those away from edges and those on them.
std::size_t pixels_of(const Verdict& v) { return v.interior().pixels + v.edges().pixels; }
std::size_t identical_of(const Verdict& v) { return v.interior().identical + v.edges().identical; }

const char* name_of(Outcome outcome) {
    constexpr const char* k_names[] = {"match", "mismatch", "undecided"};
    return k_names[static_cast<int>(outcome)];
}

constexpr const char* k_style = R"(
:root { color-scheme: light dark; }
body { font: 16px/1.5 system-ui, sans-serif; margin: 2rem auto; max-width: 75rem; padding: 0 1rem; }
table { border-collapse: collapse; width: 100%; }
th, td { padding: .4rem .8rem; text-align: right; border-bottom: 1px solid #8886; }
th:first-child, td:first-child { text-align: left; }
.match { color: #1a7f37; } .mismatch, .undecided { color: #cf222e; font-weight: bold; }
.pictures { display: grid; grid-template-columns: repeat(auto-fit, minmax(18rem, 1fr)); gap: 1rem; }
figure { margin: 0; } img { width: 100%; image-rendering: pixelated; background: #000; }
figcaption { font-size: .9rem; opacity: .8; }
)";

std::string row(const Verdict& v, const Limits& limits) {
    const std::string outcome = name_of(v.outcome(limits));
    if (!v.failure.empty())
        return fmt::format("<tr><td>{}</td><td colspan=\"10\"></td><td class=\"{}\">{}</td></tr>\n", v.target,
                           outcome, outcome);
    return fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{:.3f} %</td><td>{:.3g}</td><td>{:.4f}</td><td>{} ({:.2f} "
        "%)</td><td>{:.3g}</td><td>{}</td><td>{} of {}</td><td>{:+.3f} %</td><td>{:+.3f}, {:+.3f}</td>"
        "<td class=\"{}\">{}</td></tr>\n",
        v.target, pixels_of(v), percent(identical_of(v), pixels_of(v)), v.interior().maximum,
        v.interior().mean, v.edges().pixels, percent(v.edges().pixels, pixels_of(v)), v.edges().maximum,
        v.comparison.perceptible, v.bias.interior, v.bias.shown, 100 * v.bias.gain.value, v.bias.right.value,
        v.bias.down.value, outcome, outcome);
}

/// The remarks below the figures, a paragraph each.
std::vector<std::string> remarks_on(const Verdict& v, const Limits& limits) {
    std::vector<std::string> remarks = v.problems(limits);
    if (const std::string doubt = v.doubt(limits); !doubt.empty()) remarks.push_back(doubt);
    return remarks;
}

bool is_beyond(const Estimate& estimate, double limit, const Limits& limits) {
    return std::abs(estimate.value) > limit && estimate.deviations > limits.deviations;
}

const char* brighter_or_darker(double difference) { return difference > 0 ? "brighter" : "darker"; }

std::string image(const std::string& file, const std::string& caption) {
    return fmt::format("<figure><img src=\"{}\" alt=\"{}\"><figcaption>{}</figcaption></figure>\n", file,
                       caption, caption);
}

}  // namespace

DifferenceStatistics Verdict::edges() const {
    return comparison.differences.edges.value_or(DifferenceStatistics());
}

std::vector<std::string> Verdict::problems(const Limits& limits) const {
    if (!failure.empty()) return {failure};
    std::vector<std::string> found;
    if (interior().maximum > limits.maximum)
        found.push_back(
            fmt::format("a pixel away from edges, x {}, y {}, differs by {:.3g} levels; the limit is {:g}",
                        interior().x, interior().y, interior().maximum, limits.maximum));
    if (interior().mean > limits.mean)
        found.push_back(
            fmt::format("pixels away from edges differ by {:.3g} levels on average; the limit is {:g}",
                        interior().mean, limits.mean));
    if (is_beyond(bias.gain, limits.gain, limits))
        found.push_back(fmt::format("the picture is {} by {:.3g} %; the limit is {:g} %",
                                    brighter_or_darker(bias.gain.value), 100 * std::abs(bias.gain.value),
                                    100 * limits.gain));
    if (is_beyond(bias.right, limits.displacement, limits) ||
        is_beyond(bias.down, limits.displacement, limits))
        found.push_back(
            fmt::format("the picture is displaced by {:.3g} pixels to the right and {:.3g} down; "
                        "the limit is {:.3g}",
                        bias.right.value, bias.down.value, limits.displacement));
    const double radius = 0.5 * std::max(comparison.width, comparison.height);
    if (is_beyond(bias.zoom, limits.distortion / radius, limits))
        found.push_back(fmt::format("the picture is {} by {:.3g} %; the limit is {:.3g} %",
                                    bias.zoom.value > 0 ? "larger" : "smaller",
                                    100 * std::abs(bias.zoom.value), 100 * limits.distortion / radius));
    if (is_beyond(bias.region, limits.region, limits))
        found.push_back(
            fmt::format("the picture is {} by {:.3g} levels on average in the 16 x 16 pixels from x {}, y "
                        "{}; the limit is {:g}",
                        brighter_or_darker(bias.region.value), std::abs(bias.region.value), bias.region_x,
                        bias.region_y, limits.region));
    return found;
}

std::string Verdict::doubt(const Limits& limits) const {
    if (!failure.empty()) return {};
    const double share = percent(bias.interior, bias.shown) / 100;
    if (bias.interior >= limits.least_pixels && share >= limits.least_share) return {};
    return fmt::format(
        "of {} pixels that show more than the background, {} are away from edges; a verdict needs {} pixels "
        "and "
        "{:g} % of them. Make the picture larger (--width, --height), move the observer closer, or light the "
        "dark parts",
        bias.shown, bias.interior, limits.least_pixels, 100 * limits.least_share);
}

Outcome Verdict::outcome(const Limits& limits) const {
    if (!problems(limits).empty()) return Outcome::mismatch;
    return doubt(limits).empty() ? Outcome::match : Outcome::undecided;
}

std::string table_of(const std::vector<Verdict>& verdicts, const Limits& limits) {
    std::string text =
        fmt::format("{:<8} {:>9} {:>11} {:>8} {:>8} {:>15} {:>8} {:>12} {:>9} {:>8}\n", "target", "pixels",
                    "identical", "largest", "mean", "edges", "largest", "perceptible", "inside", "gain");
    std::string remarks;
    for (const Verdict& v : verdicts) {
        constexpr const char* k_outcomes[] = {"match", "MISMATCH", "UNDECIDED"};
        const char* const outcome = k_outcomes[static_cast<int>(v.outcome(limits))];
        text += v.failure.empty()
                    ? fmt::format(
                          "{:<8} {:>9} {:>9.3f} % {:>8.3g} {:>8.4f} {:>6} ({:.2f} %) {:>8.3g} {:>12} {:>9} "
                          "{:>6.3f} %  {}\n",
                          v.target, pixels_of(v), percent(identical_of(v), pixels_of(v)),
                          v.interior().maximum, v.interior().mean, v.edges().pixels,
                          percent(v.edges().pixels, pixels_of(v)), v.edges().maximum,
                          v.comparison.perceptible, v.bias.interior, 100 * v.bias.gain.value, outcome)
                    : fmt::format("{:<8} {}\n", v.target, outcome);
        for (const std::string& remark : remarks_on(v, limits))
            remarks += fmt::format("{}: {}\n", v.target, remark);
    }
    return text + remarks;
}

std::string json_of(const std::vector<Verdict>& verdicts, const Limits& limits) {
    const auto json = [](const Estimate& estimate) {
        return Json{{"value", estimate.value}, {"deviations", estimate.deviations}};
    };
    Json all = Json::array();
    for (const Verdict& v : verdicts) {
        Json one = {{"target", v.target},
                    {"outcome", name_of(v.outcome(limits))},
                    {"remarks", remarks_on(v, limits)}};
        if (v.failure.empty()) {
            one["comparison"] = parse_json(to_json(v.comparison));
            one["shown"] = {{"pixels", v.bias.shown}, {"away_from_edges", v.bias.interior}};
            one["bias"] = {{"gain", json(v.bias.gain)},
                           {"right", json(v.bias.right)},
                           {"down", json(v.bias.down)},
                           {"zoom", json(v.bias.zoom)},
                           {"region", json(v.bias.region)}};
            one["bias"]["region"]["at"] = {v.bias.region_x, v.bias.region_y};
        }
        all.push_back(std::move(one));
    }
    return json_text(all, 2) + "\n";
}

std::string report_page(const std::string& title, const std::vector<Verdict>& verdicts,
                        const Limits& limits) {
    const std::string name = candela::target::html_text(title);
    std::string text = fmt::format(
        "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
        "content=\"width=device-width\">\n"
        "<title>Verification of {0}</title>\n<style>{1}</style>\n<h1>Verification of {0}</h1>\n"
        "<p>Differences between Candela's picture and those of the generated programs, in levels (1/255). "
        "Pixels whose colour depends on the exact position of an edge are counted separately; all others may "
        "differ "
        "by at most {2:g}, and by {3:g} on average. "
        "Inside: pixels that show more than the background and are away from edges. Gain: how much brighter "
        "these "
        "are, in percent (limit: {4:g}). Displaced: by how many pixels the picture is displaced to the "
        "right and down (limit: {5:.3g}).</p>\n"
        "<table>\n<tr><th>program</th><th>pixels</th><th>identical</th><th>largest</th><th>mean</th><th>on "
        "edges</th>"
        "<th>largest "
        "there</th><th>perceptible</th><th>inside</th><th>gain</th><th>displaced</th><th></th></tr>\n",
        name, k_style, limits.maximum, limits.mean, 100 * limits.gain, limits.displacement);
    for (const Verdict& v : verdicts) text += row(v, limits);
    text += "</table>\n<div class=\"pictures\">\n" + image("reference.png", "Candela") +
            image("edges.png", "edges") + "</div>\n";
    for (const Verdict& v : verdicts) {
        text += fmt::format("<h2>{}</h2>\n", v.target);
        for (const std::string& remark : remarks_on(v, limits))
            text += fmt::format("<p>{}</p>\n", candela::target::html_text(remark));
        if (!v.failure.empty()) continue;
        text += "<div class=\"pictures\">\n" + image(v.target + ".png", v.target) +
                image(v.target + "-difference.png", "difference; brightest where it is largest") + "</div>\n";
    }
    return text + "</html>\n";
}

}  // namespace verify
