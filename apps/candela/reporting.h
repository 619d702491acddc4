// How a program ends: its exit code, and what it says about a failure.
#pragma once

#include <functional>
#include <new>
#include <string>

#include "exit_code.h"

import candela.diagnostics;
import candela.registry;

/// From now on nothing but errors is printed on stderr (--quiet).
void be_quiet();
bool is_quiet();

/// Prints what is good to know on stderr, unless --quiet was given.
void say(const std::string& text);

/// Says what `make` returns after the work is done. If there is no memory for that, it is not said: the
/// result is whole all the same.
template <class Make>
void say_afterwards(Make make) {
    if (is_quiet()) return;
    try {
        say(make());
    } catch (const std::bad_alloc&) {  // NOLINT(bugprone-empty-catch): the work is done
    }
}

/// Prints an error on stderr; its exit code.
int fail(ExitCode code, const std::string& message);

/// Prints a warning on stderr, unless --quiet was given.
void warn(const std::string& message);

/// Prints diagnostics on stderr; only the errors if --quiet was given.
void report(const candela::Diagnostics& diagnostics);

/// The errors as one that a command line has, to be thrown.
candela::Error usage_error(const candela::Diagnostics& diagnostics);

/// The errors among what report() has printed, without colours: for who writes down why something failed.
std::string errors_reported();

/// What an exception means to whoever gave the command.
struct Failure {
    ExitCode code;
    std::string message;
};

/// Of the exception that is being handled; one that is no std::exception passes on.
Failure current_failure();

/// Prints on stderr why plugins cannot be used; those that others were used for have been reported then.
void report_refusals(const candela::Registry& registry);

/// Prints on stderr that another plugin is used instead of one that was refused.
void report_replaced(const candela::Refusal& refused);

/// Runs a program's work and returns its exit code; what it throws is said on stderr, and so is that it
/// cannot write to standard output. Everything that is printed meanwhile passes through PrintableStreams.
int run_and_report(const std::function<int()>& work);
