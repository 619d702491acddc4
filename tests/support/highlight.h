#pragma once

#include <string>

/// How much longer horizontally than vertically the bright part of a ball is, seen from its axis of view and
/// lit from there: the ratio of the second moments of its brightness. `material`: the entries of its table.
/// The directions u and v run around the ball's vertical axis and along it.
double highlight_aspect(const std::string& reflection, const std::string& material);
