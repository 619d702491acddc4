// The report of a verification.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "compare/comparison.h"
#include "verify/bias.h"

namespace verify {

/// The limits for a program's picture; docs/internals/adr/0007 has the underlying measurements.
struct Limits {
    // For all pixels away from edges, including the background, in levels (1/255):
    double maximum = 2;
    double mean = 0.1;
    // For the values in Bias:
    double gain = 0.0005;
    double displacement = 1.0 / 32;  // pixels
    double distortion = 1.0 / 16;    // pixels by which zoom may displace the border
    double region = 0.15;            // levels
    double deviations = 5;           // standard errors within which any value may be noise
    // A verdict needs this many pixels away from edges, and this share of those above the background:
    std::size_t least_pixels = 100;
    double least_share = 0.1;
};

enum class Outcome { match, mismatch, undecided };

/// A program of one target, and how its picture compares.
struct Verdict {
    std::string target;
    std::string failure{};  // why there are no figures: the program made no comparable picture
    Comparison comparison{};
    Bias bias{};

    const DifferenceStatistics& interior() const { return comparison.differences.interior; }
    DifferenceStatistics edges() const;

    /// A sentence for each value beyond the limits; empty if there is none.
    std::vector<std::string> problems(const Limits& limits) const;
    /// Why the picture proves nothing, and what to do; empty if it proves something.
    std::string doubt(const Limits& limits) const;
    Outcome outcome(const Limits& limits) const;
};

/// A table for a terminal: the figures, one line per target below a heading, and the problems.
std::string table_of(const std::vector<Verdict>& verdicts, const Limits& limits);

/// The same as JSON: an array of objects.
std::string json_of(const std::vector<Verdict>& verdicts, const Limits& limits);

/// An HTML page that shows reference.png, edges.png, <target>.png and <target>-difference.png from its own
/// folder.
std::string report_page(const std::string& title, const std::vector<Verdict>& verdicts, const Limits& limits);

}  // namespace verify
