#include "reporting.h"

#include <fmt/color.h>
#include <fmt/format.h>

#include <exception>
#include <iostream>
#include <new>
#include <string>

#include "diagnostics_text.h"
#include "terminal.h"

int fail(ExitCode code, const std::string& message) {
    const fmt::text_style bold_red = fmt::emphasis::bold | fmt::fg(fmt::terminal_color::red);
    std::cerr << fmt::format(stderr_takes_color() ? bold_red : fmt::text_style(), "candela: error:") << ' '
              << message << '\n';
    return static_cast<int>(code);
}

void report(const candela::Diagnostics& diagnostics) {
    std::cerr << diagnostics_text(diagnostics, stderr_takes_color());
}

void report_refusals(const candela::Registry& registry) {
    for (const candela::Refusal& refusal : registry.refusals())
        std::cerr << "candela: warning: " << full_message(refusal.reason, refusal.help) << '\n';
}

int run_and_report(const std::function<int()>& work) {
    try {
        const int code = work();
        std::cout.flush();
        if (!std::cout) return fail(ExitCode::failure, "cannot write to standard output");
        return code;
    } catch (const candela::Error& problem) {
        return fail(exit_code_of(problem.category()), full_message(problem.what(), problem.help()));
    } catch (const std::bad_alloc&) {
        return fail(ExitCode::failure, "not enough memory");
    } catch (const std::exception& problem) {
        return fail(ExitCode::failure, problem.what());
    }
}
