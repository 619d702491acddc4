// How a program ends: its exit code, and what it says about a failure.
#pragma once

#include <functional>
#include <string>

#include "exit_code.h"

import candela.core;

/// Prints an error on stderr; its exit code.
int fail(ExitCode code, const std::string& message);

/// Prints diagnostics on stderr.
void report(const candela::Diagnostics& diagnostics);

/// Prints on stderr why plugins cannot be used.
void report_refusals(const candela::Registry& registry);

/// Runs a program's work and returns its exit code; what it throws is said on stderr, and so is that it
/// cannot write to standard output.
int run_and_report(const std::function<int()>& work);
