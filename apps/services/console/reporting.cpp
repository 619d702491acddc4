#include "console/reporting.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <mutex>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

#include "console/diagnostics_text.h"
#include "console/sanitized_streams.h"
#include "console/terminal.h"

import candela.util;

namespace {

bool quiet = false;
std::string reported_errors;

/// Bypasses the filter, which would escape colours. The text must be printable.
void print_styled(std::string_view text) {
    std::cerr.flush();
    std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace

void be_quiet() { quiet = true; }
bool is_quiet() { return quiet; }

void say(const std::string& text) {
    if (quiet) return;
    static std::mutex mutex;
    const std::scoped_lock lock(mutex);
    std::cerr << text;
}

int fail(ExitCode code, const std::string& message) {
    print_styled(fmt::format("{} {}\n", styled(k_bold_red, "candela: error:", stderr_takes_color()),
                             candela::printable(message, candela::LineBreaks::kept)));
    return static_cast<int>(code);
}

void warn(const std::string& message) { say(fmt::format("candela: warning: {}\n", message)); }

void report(const candela::Diagnostics& diagnostics) {
    print_styled(diagnostics_text(diagnostics, stderr_takes_color(), k_most_diagnostics_shown,
                                  quiet ? Shown::errors : Shown::errors_and_warnings));
    if (diagnostics.has_errors())
        reported_errors += diagnostics_text(diagnostics, false, k_most_diagnostics_shown, Shown::errors);
}

candela::Error usage_error(const candela::Diagnostics& diagnostics) {
    std::string problems;
    for (const candela::Diagnostic& problem : diagnostics.sorted()) {
        if (problem.severity != candela::Severity::error) continue;
        const std::string hint = full_hint(problem);
        const char* const before_hint = hint.empty() ? "" : hint.starts_with('(') ? " " : ", ";
        problems += fmt::format("{}{}: {}{}{}", problems.empty() ? "" : "; ", problem.place.file,
                                problem.message, before_hint, hint);
    }
    return {candela::ErrorCategory::bad_request, problems};
}

std::string errors_reported() { return reported_errors; }

Failure current_failure() {
    try {
        throw;
    } catch (const candela::Error& problem) {
        return {exit_code_of(problem.category()), full_message(problem.what(), problem.help())};
    } catch (const std::bad_alloc&) {
        return {ExitCode::failure, "not enough memory"};
    } catch (const std::exception& problem) {
        return {ExitCode::failure, problem.what()};
    }
}

void report_refusals(const candela::Registry& registry) {
    for (const candela::Refusal& refusal : registry.refusals()) {
        if (refusal.used_instead.empty()) warn(full_message(refusal.reason, refusal.help));
    }
}

void report_replaced(const candela::Refusal& refused) {
    warn(fmt::format("{}; using '{}' instead", full_message(refused.reason, refused.help),
                     refused.used_instead.string()));
}

namespace {

/// Memory can run out where no exception may pass: in a thread, in a destructor, or while another exception
/// is reported.
[[noreturn]] void end_without_memory() {
    try {
        if (const std::exception_ptr problem = std::current_exception()) std::rethrow_exception(problem);
    } catch (const std::bad_alloc&) {
        candela::remove_unfinished_files();
        leave_line();
        constexpr std::string_view k_message = "candela: error: not enough memory\n";
        static_cast<void>(::write(STDERR_FILENO, k_message.data(), k_message.size()));
        ::_exit(static_cast<int>(ExitCode::failure));
    } catch (...) {  // NOLINT(bugprone-empty-catch): end as without this handler
    }
    std::abort();
}

}  // namespace

int run_and_report(const std::function<int()>& work) {
    std::set_terminate(end_without_memory);
    const SanitizedStreams streams;
    try {
        const int code = work();
        std::cout.flush();
        if (!std::cout) return fail(ExitCode::failure, "cannot write to standard output");
        return code;
    } catch (const candela::KernelError& problem) {
        candela::Diagnostics diagnostics;
        problem.report_in(diagnostics);
        report(diagnostics);
        return static_cast<int>(exit_code_of(problem.category()));
    } catch (const std::exception&) {
        const Failure failure = current_failure();
        return fail(failure.code, failure.message);
    }
}
