// How a program ends: its exit code, and its error messages.
#pragma once

#include <functional>
#include <new>
#include <string>

#include "console/exit_code.h"

import candela.plugins;
import candela.util;

/// From now on, prints only errors on stderr (--quiet).
void be_quiet();
bool is_quiet();

/// Prints information on stderr, unless --quiet was given.
void say(const std::string& text);

/// Prints what `make` returns, after the work is done. If memory runs out, prints nothing: the result is
/// complete all the same.
template <class Make>
void say_afterwards(Make make) {
    if (is_quiet()) return;
    try {
        say(make());
    } catch (const std::bad_alloc&) {  // NOLINT(bugprone-empty-catch): the work is done
    }
}

/// Prints an error on stderr and returns its exit code.
int fail(ExitCode code, const std::string& message);

/// Prints a warning on stderr, unless --quiet was given.
void warn(const std::string& message);

/// Prints diagnostics on stderr; only the errors if --quiet was given.
void report(const candela::Diagnostics& diagnostics);

/// The errors as one usage error, to be thrown.
candela::Error usage_error(const candela::Diagnostics& diagnostics);

/// The errors printed by report(), without colours, to record why something failed.
std::string errors_reported();

/// The user's view of an exception.
struct Failure {
    ExitCode code;
    std::string message;
};

/// The failure for the current exception; rethrows an object that is not a std::exception.
Failure current_failure();

/// Prints on stderr why plugins cannot be used, except those that have been replaced by others and reported
/// already.
void report_refusals(const candela::Registry& registry);

/// Prints on stderr that another plugin is used instead of a refused one.
void report_replaced(const candela::Refusal& refused);

/// Runs a program's work and returns its exit code. Reports on stderr what it throws, and a failure to write
/// to standard output. Everything printed meanwhile passes through SanitizedStreams.
int run_and_report(const std::function<int()>& work);
