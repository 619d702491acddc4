// The programs that this one has started, and their descendants.
#pragma once

/// From now on, descendants whose parents have ended become children of this program, so that it can find
/// them.
void inherit_orphans() noexcept;

/// Asks the programs that this one has started to end, and waits up to five seconds. They clean up and end
/// what they have started. Otherwise like end_descendants().
void let_descendants_end() noexcept;

/// Kills all descendants. Call it on the thread that starts programs. Async-signal-safe. Does nothing without
/// /proc.
void end_descendants() noexcept;

/// From now on, a signal that ends this program also ends its descendants, after a chance to clean up. For
/// programs that work only for this one.
void end_descendants_on_signals() noexcept;
bool are_descendants_ended_on_signals() noexcept;

/// Whether one of these two was called. A thread that waited for a child then learns nothing from its end,
/// and should start no other.
bool are_descendants_ending() noexcept;
