// Calls from several threads at once.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>

/// Calls `is_as_alone(thread)` from each of `threads` threads at least `rounds` times, and until enough calls
/// have overlapped, or until `latest`. Returns whether all calls returned true. Threads are repeatedly
/// stopped in the middle of a call, so that calls also overlap on a busy machine, and on one with a single
/// processor, where threads would otherwise run one after the other. Uses SIGALRM.
bool hold_at_once(std::size_t threads, int rounds, std::chrono::steady_clock::time_point latest,
                  const std::function<bool(std::size_t thread)>& is_as_alone);
