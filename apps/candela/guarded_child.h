// Work in a process of its own, so that a crash, a hang or an exit of other people's code is a result.
#pragma once

#include <functional>
#include <string>

/// What became of the work.
struct GuardedEnd {
    std::string report;             // what it has written to its descriptor
    bool is_late = false;           // its time was over, and it was killed
    int status = 0;                 // else, as waitpid() has it
    bool leaves_processes = false;  // it had started some that were still running
    double seconds = 0;
};

/// Runs `work(report)` in a child with a process group of its own, which writes its results to the descriptor
/// `report`; standard input, output and error lead nowhere. Kills it after `seconds`, even if it is stopped.
/// All that it has started has ended when this returns, and soon after this process is killed; its temporary
/// files are gone then, too. Nothing of a library runs after `work`, such as destructors. Throws
/// std::runtime_error where no process can be started. To be called on the main thread.
GuardedEnd run_guarded(double seconds, const std::function<void(int report)>& work);

/// "ends the process with exit code 0", "has not finished after 20 s": of work that was to report something,
/// and did not.
std::string unexpected_end_of(const GuardedEnd& end, double seconds);
