// One group of checks in a process of its own, so that a crash, a hang or an exit is a result.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "outcome.h"

/// Where a child says what it found: lines of "<verdict> <message>", and "done" at the end.
class Findings {
  public:
    explicit Findings(int descriptor) : descriptor_(descriptor) {}
    void add(const char* verdict, const std::string& message);

  private:
    int descriptor_;
};

/// Runs `work` in a child with a process group of its own, standard output and error thrown away; ends it
/// after `seconds`. Whatever it started has ended when this returns, and soon after this process is killed;
/// its temporary files are gone then, too.
Outcome run_in_child(const std::string& group, double seconds, const std::function<void(Findings&)>& work);

/// Runs `work` in this process, where a debugger sees it; without a limit.
Outcome run_here(const std::string& group, const std::function<void(Findings&)>& work);
