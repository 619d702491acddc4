#include "reporting.h"

#include <exception>
#include <iostream>
#include <new>
#include <string>

#include "terminal.h"

import candela.core;

namespace {

using candela::ExitCode;

int fail(ExitCode code, const std::string& message) {
    std::cerr << (stderr_takes_color() ? "\x1b[1;31mcandela: error:\x1b[0m " : "candela: error: ") << message
              << '\n';
    return static_cast<int>(code);
}

}  // namespace

int run_and_report(const std::function<int()>& work) {
    try {
        const int code = work();
        std::cout.flush();
        if (!std::cout) return fail(ExitCode::failure, "standard output cannot be written");
        return code;
    } catch (const candela::Error& problem) {
        return fail(problem.code(), problem.what());
    } catch (const std::bad_alloc&) {
        return fail(ExitCode::failure, "not enough memory");
    } catch (const std::exception& problem) {
        return fail(ExitCode::failure, problem.what());
    }
}
