// The programs that this one has started, and those that they have started.
#pragma once

/// From here on, programs whose parents have ended become children of this one, so that they are found.
void inherit_orphans() noexcept;

/// Kills them all. To be called on the thread that starts programs; async-signal-safe. Without /proc, it
/// kills none.
void end_descendants() noexcept;
