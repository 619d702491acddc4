// Talks to the user: colour, questions and progress, on a terminal only.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

/// Whether stderr may be coloured: it is a terminal, and NO_COLOR is not set.
bool stderr_takes_color();

/// Codes that change how a terminal shows text. (<fmt/color.h> takes a second to compile in each file.)
inline constexpr std::string_view k_bold = "\x1b[1m", k_bold_red = "\x1b[1m\x1b[31m",
                                  k_bold_green = "\x1b[1m\x1b[32m", k_bold_magenta = "\x1b[1m\x1b[35m";

/// The text between a style's code and that of the usual style; the text alone if not `in_color`.
std::string styled(std::string_view style, std::string_view text, bool in_color);

/// Whether the user can be asked: both stdin and stderr are terminals.
bool can_ask();

/// Asks on stderr until there is an answer; an empty line means yes, the end of input means no.
bool ask(const std::string& question);

/// Ends the line of an open question, and erases an open progress bar. For signal handlers
/// (async-signal-safe).
void leave_line() noexcept;

/// A bar on stderr for work that takes longer than half a second, if stderr is a terminal and `is_wanted`.
class ProgressBar {
  public:
    explicit ProgressBar(std::string label, bool is_wanted = true);
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    ~ProgressBar();

    /// Any thread.
    void update(std::size_t done, std::size_t all);
    /// update() as a callback.
    std::function<void(std::size_t done, std::size_t all)> updater() {
        return [this](std::size_t done, std::size_t all) { update(done, all); };
    }

  private:
    void draw();
    std::string time_left(std::size_t all) const;

    std::string label_;
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    std::atomic<std::size_t> done_{0}, all_{0};
    std::mutex mutex_;
    std::condition_variable end_;
    bool ended_ = false;
    std::thread thread_;
};
