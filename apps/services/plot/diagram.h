// Shared by all diagrams: their colours, their legend, and text in SVG and CSV.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

import candela.api;

/// The intensity that diagrams show: the luminance of linear RGB (Rec. ITU-R BT.709).
double luminance(const candela::Vec3& rgb);

inline constexpr double k_legend_row = 22;

/// Any text, made printable and escaped for SVG.
std::string in_xml(const std::string& text);
/// A table cell as in RFC 4180.
std::string in_csv(const std::string& text);

/// The attributes that distinguish a curve from the others.
std::string curve_style(std::size_t index);
/// Rows of a dash and a label, starting at `y`.
std::string legend_of(const std::vector<std::string>& labels, double y);

/// The start of a drawing with a title ("`title`: a, b") and a description for screen readers.
std::string svg_begin(double width, double height, const std::string& title,
                      const std::vector<std::string>& labels, const std::string& description);
