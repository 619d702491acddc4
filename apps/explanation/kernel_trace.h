// Kernel text that tells what it computes: each statement that gives a name a value, and each return, is
// followed by a note of that value.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// What a note is about.
struct KernelStep {
    enum class Kind { function, argument, value, result };
    Kind kind = Kind::value;
    std::string file;      // "phong.kernel"
    std::size_t line = 0;  // of the statement, from 1
    std::string name;      // of the function, the argument or what is assigned to; "return"
    std::string text;      // the statement as it is written, on one line, without comments
};

/// The number of a note is the index of its step.
struct TracedKernels {
    std::vector<KernelStep> steps;

    /// The kernel, with notes. Text that is not in the kernel language comes out as something that a compiler
    /// refuses. `file` is what steps and the compiler's messages call it.
    std::string traced(std::string_view text, const std::string& file);
};

/// What the text of TracedKernels::traced() needs before it: C++ that prints a line per note.
std::string_view kernel_trace_prelude() noexcept;
