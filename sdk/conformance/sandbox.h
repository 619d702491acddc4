// Limits for what is not trusted: the text of an answer to an exercise, compiled and run.
#pragma once

#include <cstddef>

/// The exit code of a process that confine() has ended.
inline constexpr int k_cannot_be_confined = 125;

/// For this process and all that it starts, compilers: processor time, size of files and memory. They are
/// limits on accidents; what may be in a text at all is decided before it comes here.
void limit_compiling();

/// From here on this process computes in the memory that it has, with `room` bytes more, for `seconds` of
/// processor time, and does nothing else: any system call but those for memory and for ending ends it
/// (SIGSYS). Ends the process where the system cannot be told so. Irrevocable; for a child.
void confine(std::size_t room, unsigned seconds);
