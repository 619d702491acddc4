// How a program ends: its exit code, and what it says about a failure.
#pragma once

#include <functional>

/// Runs a program's work and returns its exit code; what it throws is said on stderr, and so is that standard
/// output could not be written.
int run_and_report(const std::function<int()>& work);
