// Pixels explained for candela view, as quickly as somebody clicks.
#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "view/request.h"
#include "view/server.h"

import candela.process;

/// A `candela explain` that has read the scene and compiled its models' kernels before anybody asks, and
/// waits for pixels; one at a time, and none where nobody has asked for long. It is another one whenever the
/// scene changes, and where somebody has changed something else in the page.
class Explainer {
  public:
    /// `arguments` are those of `candela explain`.
    explicit Explainer(std::vector<std::string> arguments);
    Explainer(const Explainer&) = delete;
    Explainer& operator=(const Explainer&) = delete;
    /// Waits for the end of the program.
    ~Explainer();

    /// What `candela explain` says of a pixel, as JSON; the pixel is among `changes`. Waits for it. Any
    /// thread.
    view::Outcome explain(const std::vector<view::Change>& changes);
    /// The scene is another one now. Once no more of it changes, a program gets ready for it. Any thread;
    /// does not wait.
    void scene_changed();

  private:
    using Clock = std::chrono::steady_clock;

    void get_ready();
    /// For whoever has locked using_.
    void start(const std::vector<std::string>& options);

    std::vector<std::string> arguments_;

    std::mutex using_;                  // what follows
    std::vector<std::string> options_;  // of the program, or of the one before: what somebody has changed
    std::unique_ptr<candela::AnsweringProgram> program_;

    std::mutex waiting_;  // what follows
    std::condition_variable news_;
    bool is_outdated_ = false, is_ending_ = false;
    Clock::time_point latest_;  // use, or change of the scene
    std::thread thread_;        // the last, since it uses all the others
};
