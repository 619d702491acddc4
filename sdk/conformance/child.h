// Runs one group of checks in its own process, so that a crash, a hang or an exit is a result.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "outcome.h"

/// A child's report of its findings: lines of "<verdict> <message>", and "done" at the end.
class Findings {
  public:
    explicit Findings(int descriptor) : descriptor_(descriptor) {}
    void add(const char* verdict, const std::string& message);

  private:
    int descriptor_;
};

/// Runs `work` in a child with its own process group, discarding standard output and error, and ends it after
/// `seconds`. When this returns, everything that the child started has ended; if this process is killed, that
/// happens soon afterwards. Temporary files are removed in both cases.
Outcome run_in_child(const std::string& group, double seconds, const std::function<void(Findings&)>& work);

/// Runs `work` in this process, where a debugger can see it; without a time limit.
Outcome run_here(const std::string& group, const std::function<void(Findings&)>& work);
