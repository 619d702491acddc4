// Makes kernel text report what it computes: a note of the value follows each assignment and each return.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// The subject of a note.
struct KernelStep {
    enum class Kind { function, argument, value, result };
    Kind kind = Kind::value;
    std::string file;      // "phong.kernel"
    std::size_t line = 0;  // the statement's line, from 1
    std::string name;      // of the function, the argument or the assigned variable; or "return"
    std::string text;      // the statement as written, on one line, without comments
};

/// A note's number is the index of its step.
struct TracedKernels {
    std::vector<KernelStep> steps;

    /// The kernel with notes. For text outside the kernel language, the result is text that a compiler
    /// rejects. `file` names it in steps and compiler messages.
    std::string traced(std::string_view text, const std::string& file);
};

/// The code that TracedKernels::traced() needs before its text: C++ that prints a line per note.
std::string_view kernel_trace_prelude() noexcept;
