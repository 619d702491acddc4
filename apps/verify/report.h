// A verification as a page to look at.
#pragma once

#include <string>
#include <vector>

#include "verify/comparison.h"

namespace verify {

struct Limits {
    double maximum = 2;  // levels of 1/255, for pixels away from edges
    double mean = 0.1;
};

/// A program of one target, and how its picture compares.
struct Verdict {
    std::string target;
    Comparison comparison;

    const DifferenceStatistics& interior() const { return comparison.differences.interior; }
    DifferenceStatistics edges() const;
    bool is_match(const Limits& limits) const;
};

/// The figures, one line a target below a heading, for a terminal.
std::string table_of(const std::vector<Verdict>& verdicts, const Limits& limits);

/// An HTML page that shows, from its own folder, reference.png, edges.png, <target>.png and
/// <target>-difference.png.
std::string report_page(const std::string& title, const std::vector<Verdict>& verdicts, const Limits& limits);

}  // namespace verify
