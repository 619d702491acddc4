// The programs that this one has started, and those that they have started.
#pragma once

/// From here on, programs whose parents have ended become children of this one, so that they are found.
void inherit_orphans() noexcept;

/// Asks the programs that this one has started to end, and waits for that, up to five seconds. They end what
/// they have started themselves, and clean up. Like end_descendants() otherwise.
void let_descendants_end() noexcept;

/// Kills them all. To be called on the thread that starts programs; async-signal-safe. Without /proc, it
/// kills none.
void end_descendants() noexcept;

/// From here on, a signal that ends this program ends them too, for programs that work for it alone; they can
/// clean up before.
void end_descendants_on_signals() noexcept;
bool are_descendants_ended_on_signals() noexcept;

/// Whether one of these two was called: who has waited for one of them on another thread learns nothing from
/// its end, and should start no other.
bool are_descendants_ending() noexcept;
