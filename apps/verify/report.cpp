#include "verify/report.h"

#include <fmt/format.h>

#include "candela/target/literals.h"

namespace verify {

namespace {

double percent(std::size_t part, std::size_t whole) {
    return whole == 0 ? 0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

/// Of all pixels, those away from edges and those on them.
std::size_t pixels_of(const Verdict& v) { return v.interior().pixels + v.edges().pixels; }
std::size_t identical_of(const Verdict& v) { return v.interior().identical + v.edges().identical; }

constexpr const char* k_style = R"(
:root { color-scheme: light dark; }
body { font: 16px/1.5 system-ui, sans-serif; margin: 2rem auto; max-width: 75rem; padding: 0 1rem; }
table { border-collapse: collapse; width: 100%; }
th, td { padding: .4rem .8rem; text-align: right; border-bottom: 1px solid #8886; }
th:first-child, td:first-child { text-align: left; }
.match { color: #1a7f37; } .mismatch { color: #cf222e; font-weight: bold; }
.pictures { display: grid; grid-template-columns: repeat(auto-fit, minmax(18rem, 1fr)); gap: 1rem; }
figure { margin: 0; } img { width: 100%; image-rendering: pixelated; background: #000; }
figcaption { font-size: .9rem; opacity: .8; }
)";

std::string row(const Verdict& v, const Limits& limits) {
    const bool is_match = v.is_match(limits);
    return fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{:.3f} %</td><td>{:.3g}</td><td>{:.4f}</td><td>{} ({:.2f} "
        "%)</td><td>{:.3g}</td>"
        "<td>{}</td><td class=\"{}\">{}</td></tr>\n",
        v.target, pixels_of(v), percent(identical_of(v), pixels_of(v)), v.interior().maximum,
        v.interior().mean, v.edges().pixels, percent(v.edges().pixels, pixels_of(v)), v.edges().maximum,
        v.comparison.perceptible, is_match ? "match" : "mismatch", is_match ? "match" : "mismatch");
}

std::string picture(const std::string& file, const std::string& caption) {
    return fmt::format("<figure><img src=\"{}\" alt=\"{}\"><figcaption>{}</figcaption></figure>\n", file,
                       caption, caption);
}

}  // namespace

DifferenceStatistics Verdict::edges() const {
    return comparison.differences.edges.value_or(DifferenceStatistics());
}

bool Verdict::is_match(const Limits& limits) const {
    return interior().maximum <= limits.maximum && interior().mean <= limits.mean;
}

std::string table_of(const std::vector<Verdict>& verdicts, const Limits& limits) {
    std::string text = fmt::format("{:<8} {:>9} {:>11} {:>8} {:>8} {:>15} {:>8} {:>12}\n", "target", "pixels",
                                   "identical", "largest", "mean", "edges", "largest", "perceptible");
    for (const Verdict& v : verdicts) {
        text += fmt::format("{:<8} {:>9} {:>9.3f} % {:>8.3g} {:>8.4f} {:>6} ({:.2f} %) {:>8.3g} {:>12}  {}\n",
                            v.target, pixels_of(v), percent(identical_of(v), pixels_of(v)),
                            v.interior().maximum, v.interior().mean, v.edges().pixels,
                            percent(v.edges().pixels, pixels_of(v)), v.edges().maximum,
                            v.comparison.perceptible, v.is_match(limits) ? "match" : "MISMATCH");
    }
    return text;
}

std::string report_page(const std::string& title, const std::vector<Verdict>& verdicts,
                        const Limits& limits) {
    const std::string name = candela::target::html_text(title);
    std::string text = fmt::format(
        "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
        "content=\"width=device-width\">\n"
        "<title>Verification of {0}</title>\n<style>{1}</style>\n<h1>Verification of {0}</h1>\n"
        "<p>Differences between Candela's picture and those of the generated programs, in levels of 1/255. "
        "Pixels whose colour "
        "depends on where exactly an edge lies are counted apart; all others may differ by {2:g} at most, "
        "and by {3:g} on "
        "average.</p>\n"
        "<table>\n<tr><th>program</th><th>pixels</th><th>identical</th><th>largest</th><th>mean</th><th>on "
        "edges</th>"
        "<th>largest there</th><th>perceptible</th><th></th></tr>\n",
        name, k_style, limits.maximum, limits.mean);
    for (const Verdict& v : verdicts) text += row(v, limits);
    text += "</table>\n<div class=\"pictures\">\n" + picture("reference.png", "Candela") +
            picture("edges.png", "edges") + "</div>\n";
    for (const Verdict& v : verdicts) {
        text += fmt::format("<h2>{}</h2>\n<div class=\"pictures\">\n", v.target) +
                picture(v.target + ".png", v.target) +
                picture(v.target + "-difference.png", "difference; the largest is brightest") + "</div>\n";
    }
    return text + "</html>\n";
}

}  // namespace verify
