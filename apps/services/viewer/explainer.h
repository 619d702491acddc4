// Explains pixels for candela view without making the user wait.
#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "process/process.h"
#include "viewer/request.h"
#include "viewer/server.h"

import candela.util;

/// Runs a `candela explain` that has read the scene and compiled its models' kernels before the first
/// request, and then waits for pixels, one at a time. Ends it after a long idle time. Replaces it whenever
/// the scene changes, or the changes made in the page differ.
class Explainer {
  public:
    /// `arguments` are those of `candela explain`.
    explicit Explainer(std::vector<std::string> arguments);
    Explainer(const Explainer&) = delete;
    Explainer& operator=(const Explainer&) = delete;
    /// Waits for the program to end.
    ~Explainer();

    /// The output of `candela explain` for a pixel, as JSON; the pixel is among `changes`. Waits for it. Any
    /// thread.
    view::Outcome explain(const std::vector<view::Change>& changes);
    /// Tells it that the scene has changed. Once the changes settle, it prepares a new program. Any thread;
    /// does not wait.
    void scene_changed();

  private:
    using Clock = std::chrono::steady_clock;

    void get_ready();
    /// The caller has locked using_.
    void start(const std::vector<std::string>& options);

    std::vector<std::string> arguments_;

    std::mutex using_;                  // guards what follows
    std::vector<std::string> options_;  // of the program, or the last one: the changes made in the page
    std::unique_ptr<candela::AnsweringProgram> program_;

    std::mutex waiting_;  // guards what follows
    std::condition_variable news_;
    bool is_outdated_ = false, is_ending_ = false;
    Clock::time_point latest_;  // the latest use, or change of the scene
    std::thread thread_;        // declared last: it uses all the other members
};
