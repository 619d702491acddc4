// Runs untrusted code in a process of its own, so that a crash, a hang or an exit is a result.
#pragma once

#include <functional>
#include <string>

/// How the work ended.
struct GuardedEnd {
    std::string report;             // what it wrote to its descriptor
    bool is_late = false;           // it ran out of time and was killed
    int status = 0;                 // otherwise, as from waitpid()
    bool leaves_processes = false;  // it left child processes running
    double seconds = 0;
};

/// Runs `work(report)` in a child with a process group of its own, which writes its results to the descriptor
/// `report`; standard input, output and error are /dev/null. Kills it after `seconds`, even if it is stopped.
/// All processes it started have ended, and its temporary files are gone, when this returns, or soon after
/// this process is killed. No library code, such as destructors, runs after `work`. Throws std::runtime_error
/// if no process can be started. Call it on the main thread.
GuardedEnd run_guarded(double seconds, const std::function<void(int report)>& work);

/// "ended the process with exit code 0", "did not finish within 20 s": for work that should have reported
/// something and did not.
std::string unexpected_end_of(const GuardedEnd& end, double seconds);
