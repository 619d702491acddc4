// candela plot: compares with closed forms of the models' equations, and with a least-squares fit computed
// here.
#include <algorithm>
#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/text.h"

namespace fs = std::filesystem;
using Catch::Approx;

namespace {

constexpr double k_degree = 0.017453292519943295;

/// The first line's cells, some of them quoted.
std::vector<std::string> header_of(const std::string& line) {
    std::vector<std::string> cells(1);
    bool is_quoted = false;
    for (const char c : line) {
        if (c == '"') {
            is_quoted = !is_quoted;
        } else if (c == ',' && !is_quoted) {
            cells.emplace_back();
        } else {
            cells.back() += c;
        }
    }
    return cells;
}

struct Table {
    std::vector<std::string> columns;
    std::vector<std::vector<double>> rows;

    explicit Table(const std::string& csv) {
        std::istringstream lines(csv);
        std::string line;
        std::getline(lines, line);
        columns = header_of(line);
        while (std::getline(lines, line)) {
            std::istringstream cells(line);
            rows.emplace_back();
            for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::stod(cell));
        }
    }

    double at(double angle, const std::string& column) const {
        const auto found = std::ranges::find(columns, column);
        const auto row = std::ranges::find_if(rows, [&](const auto& r) { return r.front() == angle; });
        INFO(column << " at " << angle);
        REQUIRE(found != columns.end());
        REQUIRE(row != rows.end());
        return row->at(static_cast<std::size_t>(found - columns.begin()));
    }
};

Table plotted(std::vector<std::string> words) {
    words.insert(words.begin(), "plot");
    const CommandResult result = succeeded(run_candela(words));
    return Table(result.out);
}

/// The light emitted by lights: "over,at,<light>...".
struct LightTable {
    explicit LightTable(std::vector<std::string> words) {
        words.insert(words.begin(), "plot");
        const CommandResult result = succeeded(run_candela(words));
        std::istringstream lines(result.out);
        std::string line;
        std::getline(lines, line);
        REQUIRE(header_of(line)[0] == "over");
        while (std::getline(lines, line)) {
            const std::size_t comma = line.find(',');
            std::istringstream cells(line.substr(comma + 1));
            std::vector<double> numbers;
            for (std::string cell; std::getline(cells, cell, ',');) numbers.push_back(std::stod(cell));
            rows.emplace_back(line.substr(0, comma), numbers);
        }
    }

    double at(const std::string& over, double place, std::size_t light) const {
        for (const auto& [name, numbers] : rows)
            if (name == over && std::abs(numbers[0] - place) < 1e-6 * place + 1e-9)
                return numbers.at(light + 1);
        FAIL("no row for " << over << " " << place);
        return 0;
    }

    std::vector<std::pair<std::string, std::vector<double>>> rows;
};

/// The cosine, and nothing from behind.
double cosine(double degrees) { return std::max(0.0, std::cos(degrees * k_degree)); }

double number_behind(const std::string& text, const std::string& words) {
    const std::size_t at = text.find(words);
    REQUIRE(at != std::string::npos);
    return std::stod(text.substr(at + words.size()));
}

}  // namespace

TEST_CASE("plot: Phong's lobe is a power of the cosine to the mirror direction, plus Lambert's constant") {
    const std::string model = "phong:kd=0.5,ks=0.25,shininess=20";
    const Table table = plotted({"reflection/" + model, "--incidence", "30"});
    CHECK(table.rows.size() == 359);
    for (const double angle : {-89.5, -70.0, -20.0, 0.0, 30.0, 45.0, 89.5}) {
        CHECK(table.at(angle, model + " diffuse") == Approx(0.5 * std::cos(30 * k_degree)).epsilon(1e-5));
        const double specular = 0.25 * std::pow(cosine(angle - 30), 20);
        CHECK(table.at(angle, model + " specular") == Approx(specular).epsilon(1e-4).margin(1e-7));
        CHECK(table.at(angle, model + " intensity") ==
              Approx(0.5 * std::cos(30 * k_degree) + specular).epsilon(1e-5));
    }
}

TEST_CASE("plot: a model's own value overrides the one for all models, and lists stay together") {
    const Table table = plotted({"phong:shininess=5", "blinn-phong", "lambert:kd=[0.2,0.2,0.2]",
                                 "--set=shininess=40", "--set", "kd=0", "--set", "ks=1"});
    // Half of the light from 45 degrees, seen along the normal: H is at 22.5 degrees.
    CHECK(table.at(0, "phong:shininess=5,kd=0,ks=1 specular") ==
          Approx(std::pow(std::cos(45 * k_degree), 5)).epsilon(1e-4));
    CHECK(table.at(0, "blinn-phong:shininess=40,kd=0,ks=1 specular") ==
          Approx(std::pow(std::cos(22.5 * k_degree), 40)).epsilon(1e-4));
}

TEST_CASE("plot: --match finds the exponent of Blinn-Phong's lobe that is nearest to Phong's") {
    const CommandResult result = succeeded(run_candela(
        {"plot", "phong:shininess=20", "blinn-phong", "--match", "shininess", "--incidence", "30"}));
    // In this plane R.V = cos(a) and N.H = cos(a / 2), with a from the mirror direction: the same least
    // squares fit here.
    double best = 0, least = 1e30;
    for (double n = 40; n < 160; n += 0.01) {
        double sum = 0;
        for (double angle = -89.5; angle < 90; angle += 0.5) {
            const double a = angle - 30;
            sum += std::pow(std::pow(cosine(a), 20) - std::pow(cosine(a / 2), n), 2);
        }
        if (sum < least) least = sum, best = n;
    }
    const double found = number_behind(result.out, "blinn-phong:shininess=");
    CHECK(found == Approx(best).epsilon(1e-3));
    // Fisher and Woo (1994), "R.E versus N.H specular highlights", Graphics Gems IV: about four times.
    CHECK(found == Approx(80).epsilon(0.05));
    CHECK(number_behind(result.out, "the difference is ") ==
          Approx(100 * 0.3 * std::sqrt(least / 359) / (0.7 * std::cos(30 * k_degree) + 0.3)).epsilon(0.1));
}

TEST_CASE("plot: a diagram is SVG with a curve for each model, whose radius is the intensity") {
    const fs::path file = scratch_directory() / "lobes.svg";
    const CommandResult result = succeeded(run_candela(
        {"plot", "reflection/lambert:kd=0.5", "reflection/phong", "--incidence", "60", "-o", file.string()}));
    CHECK(result.out.empty());
    // Reads it with an independent parser. Lambert's curve is 0.5 cos 60 everywhere, on a diagram whose rim
    // is a power of ten times 1, 2 or 5.
    const CommandResult parsed = succeeded(run_program({"python3", "-c", R"(
import math, sys, xml.etree.ElementTree as tree
root = tree.parse(sys.argv[1]).getroot()
name = "{http://www.w3.org/2000/svg}"
assert root.tag == name + "svg" and root.find(name + "title").text.endswith("lambert:kd=0.5, phong")
curves = [[tuple(map(float, p.split(","))) for p in c.get("points").split()] for c in root.iter(name + "polyline")]
assert [len(c) for c in curves] == [359, 359]
rim = max(float(t.text) for t in root.iter(name + "text") if t.get("font-size") == "11" and "°" not in t.text)
radii = [math.hypot(x - 360, y - 335) / 300 * rim for x, y in curves[0]]
print(min(radii), max(radii)))",
                                                        file.string()}));
    std::istringstream radii(parsed.out);
    double least = 0, most = 0;
    radii >> least >> most;
    CHECK(least == Approx(0.25).epsilon(1e-3));
    CHECK(most == Approx(0.25).epsilon(1e-3));
}

TEST_CASE("plot: a spot light fades between its cones, and with the square of the distance") {
    const std::string smooth = "spot:inner_angle=20,outer_angle=40,intensity=3";
    const std::string linear = "spot:inner_angle=20,outer_angle=40,falloff=linear,attenuation=none";
    const LightTable table({"light/" + smooth, "light/" + linear, "light/point:intensity=3"});
    for (const double angle : {0.0, 10.0, 19.5, 22.0, 30.0, 38.5, 40.5, 90.0}) {
        // SPEC §3: smoothstep of the cosine between the cones, or linear in it.
        const double t = std::clamp((std::cos(angle * k_degree) - std::cos(40 * k_degree)) /
                                        (std::cos(20 * k_degree) - std::cos(40 * k_degree)),
                                    0.0, 1.0);
        CHECK(table.at("angle", angle, 0) == Approx(3 * t * t * (3 - 2 * t)).epsilon(1e-4).margin(1e-6));
        CHECK(table.at("angle", angle, 1) == Approx(t).epsilon(1e-4).margin(1e-6));
        CHECK(table.at("angle", angle, 2) == Approx(3).epsilon(1e-5));
    }
    for (const double distance : {0.1, 0.2511886, 1.0, 3.162278, 10.0}) {
        CHECK(table.at("distance", distance, 0) ==
              Approx(3 / (distance * distance)).epsilon(1e-4));  // CA DD7
        CHECK(table.at("distance", distance, 1) == Approx(1).epsilon(1e-5));
    }
}

TEST_CASE("plot: RE's attenuation has no pole, and a light's own value overrides the one for all lights") {
    const LightTable table({"light/point:attenuation=offset-linear,attenuation_offset=0.01", "light/point",
                            "--set=intensity=0.8"});
    for (const double distance : {0.1, 1.0, 10.0}) {
        CHECK(table.at("distance", distance, 0) ==
              Approx(0.8 / (distance + 0.01)).epsilon(1e-4));  // RE: 1/(r+k)
        CHECK(table.at("distance", distance, 1) == Approx(0.8 / (distance * distance)).epsilon(1e-4));
    }
}

TEST_CASE("plot: the curves in a light's diagrams follow its equation") {
    const fs::path file = scratch_directory() / "spot.svg";
    REQUIRE(
        run_candela({"plot", "light/spot:inner_angle=0,outer_angle=60,falloff=linear", "-o", file.string()})
            .exit_code == 0);
    const std::string svg = read_file(file);
    CHECK(holds(svg, "role=\"img\""));
    CHECK(holds(
        svg, "<title id=\"title\">Emitted light: spot:inner_angle=0,outer_angle=60,falloff=linear</title>"));
    // At 0 degrees the top left corner of its frame; at 60 degrees, two thirds to the right, the bottom.
    const std::size_t curve = svg.find("points=\"");
    REQUIRE(curve != std::string::npos);
    CHECK(svg.compare(curve + 8, 12, "60.00,40.00 ") == 0);
    CHECK(holds(svg, " 306.67,340.00 "));
}

TEST_CASE("plot: an impossible diagram is an error with the possible choices, and no file is written") {
    struct Wrong {
        std::vector<std::string> words;
        const char* message;
    };
    for (const Wrong& wrong : {
             Wrong{{}, "needs a model"},
             Wrong{{"shading/flat"}, "expected a reflection model or a light"},
             Wrong{{"light/point", "phong"}, "either reflection models or lights"},
             Wrong{{"light/point", "--log"}, "--log applies to reflection models"},
             Wrong{{"light/ambient"}, "comes from everywhere"},
             Wrong{{"light/spot:outer_angl=3"}, "did you mean 'outer_angle'"},
             Wrong{{"light/spot:inner_angle=30,outer_angle=20"}, "inner_angle"},
             Wrong{{"phong", "lambert", "--set", "shinines=3"}, "did you mean 'shininess'"},
             Wrong{{"phong:shininess"}, "is not a value"},
             Wrong{{"phong:shinines=3"}, "did you mean 'shininess'"},
             Wrong{{"phong:shininess=-3"}, "outside its range"},
             Wrong{{"phong", "--incidence", "90"}, "less than 90"},
             Wrong{{"phong", "-o", "lobe.png"}, ".svg nor .csv"},
             Wrong{{"phong", "--match", "shininess"}, "--match needs"},
             Wrong{{"phong", "lambert", "--match", "shininess"}, "has no number 'shininess'"},
         }) {
        std::vector<std::string> words = wrong.words;
        words.insert(words.begin(), "plot");
        const Folder folder;
        const CommandResult result = expect(folder.run_words(words), 2, {wrong.message});
        CHECK(result.out.empty());
        CHECK(fs::is_empty(folder));
    }
    expect(run_candela({"plot", "reflection/phnog"}), 1, {"did you mean 'phong'"});
    expect(run_candela({"plot", "phong", "-o", "/nonexistent/lobe.svg"}), 1);
}
