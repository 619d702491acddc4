// Limits for untrusted code: the text of an answer to an exercise, compiled and run.
#pragma once

#include <cstddef>

/// The exit code of a process that could not be confined.
inline constexpr int k_cannot_be_confined = 125;

/// Limits processor time, file size and memory of this process and its children, which are compilers. This
/// protects against accidents; what a text may contain is decided before it comes here.
void limit_compiling();

/// From now on, this process can only compute, in its present memory and `room` bytes more, for `seconds` of
/// processor time: any system call except those for memory and for exiting ends it (SIGSYS). Ends the process
/// if the system does not support this. Irrevocable; for a child.
void confine(std::size_t room, unsigned seconds);
