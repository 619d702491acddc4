// A verification as a page to look at.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "picture_comparison/comparison.h"
#include "verify/bias.h"

namespace verify {

/// What a program's picture may do; docs/adr/0007 has the measurements behind it.
struct Limits {
    // Of all pixels away from edges, background among them, in levels of 1/255:
    double maximum = 2;
    double mean = 0.1;
    // Of what Bias counts:
    double gain = 0.0005;
    double displacement = 1.0 / 32;  // pixels
    double distortion = 1.0 / 16;    // pixels that zoom or roll may displace the border
    double region = 0.15;            // levels
    double deviations = 5;  // what is within as many standard errors may be noise, however large it is
    // A verdict rests on as many pixels away from edges, and on that share of those that show something:
    std::size_t least_pixels = 100;
    double least_share = 0.1;
};

enum class Outcome { match, mismatch, undecided };

/// A program of one target, and how its picture compares.
struct Verdict {
    std::string target;
    std::string failure{};  // why there are no figures: the program made no picture that could be compared
    Comparison comparison{};
    Bias bias{};

    const DifferenceStatistics& interior() const { return comparison.differences.interior; }
    DifferenceStatistics edges() const;

    /// What is beyond the limits, a sentence each; none where nothing is.
    std::vector<std::string> problems(const Limits& limits) const;
    /// Why the picture proves nothing, and what to do; empty where it does.
    std::string doubt(const Limits& limits) const;
    Outcome outcome(const Limits& limits) const;
};

/// The figures, one line a target below a heading, and what is wrong, for a terminal.
std::string table_of(const std::vector<Verdict>& verdicts, const Limits& limits);

/// The same for programs: an array of objects.
std::string json_of(const std::vector<Verdict>& verdicts, const Limits& limits);

/// An HTML page that shows, from its own folder, reference.png, edges.png, <target>.png and
/// <target>-difference.png.
std::string report_page(const std::string& title, const std::vector<Verdict>& verdicts, const Limits& limits);

}  // namespace verify
