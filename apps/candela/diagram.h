// What diagrams have in common: their colours, their legend, and texts in SVG and CSV.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

import candela.math;

/// What diagrams show of an intensity: the luminance of linear RGB (Rec. ITU-R BT.709).
double luminance(const candela::Vec3& rgb);

inline constexpr double k_legend_row = 22;

/// Any text, printable, within SVG.
std::string in_xml(const std::string& text);
/// A cell of a table, as RFC 4180 has it.
std::string in_csv(const std::string& text);

/// The attributes of a curve, by which it can be told from the others.
std::string curve_style(std::size_t index);
/// Rows of a dash and a label, from `y` on.
std::string legend_of(const std::vector<std::string>& labels, double y);

/// The beginning of a drawing with a title ("`title`: a, b") and a description for those who do not see it.
std::string svg_begin(double width, double height, const std::string& title,
                      const std::vector<std::string>& labels, const std::string& description);
