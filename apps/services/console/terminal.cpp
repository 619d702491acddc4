#include "console/terminal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <string_view>

namespace {

using namespace std::chrono_literals;

bool is_terminal(int descriptor) { return ::isatty(descriptor) == 1; }

enum class OpenLine : int { none, question, bar };
constinit std::atomic<OpenLine> open_line{OpenLine::none};
static_assert(std::atomic<OpenLine>::is_always_lock_free, "a signal handler may not wait");

}  // namespace

bool stderr_takes_color() {
    const char* const no_color = std::getenv("NO_COLOR");
    const char* const term = std::getenv("TERM");
    return is_terminal(STDERR_FILENO) && (no_color == nullptr || *no_color == '\0') &&
           (term == nullptr || std::string(term) != "dumb");
}

std::string styled(std::string_view style, std::string_view text, bool in_color) {
    return in_color ? fmt::format("{}{}\x1b[0m", style, text) : std::string(text);
}

bool can_ask() { return is_terminal(STDIN_FILENO) && is_terminal(STDERR_FILENO); }

bool ask(const std::string& question) {
    for (const char* before = "";; before = "Please answer y or n. ") {
        open_line = OpenLine::question;  // the user may answer with Ctrl-C at once
        std::cerr << before << question << " [Y/n] " << std::flush;
        std::string answer;
        const bool is_answered = static_cast<bool>(std::getline(std::cin, answer));
        open_line = OpenLine::none;
        if (!is_answered) {
            std::cerr << '\n';
            return false;
        }
        std::erase_if(answer, [](unsigned char c) { return std::isspace(c) != 0; });
        std::ranges::transform(answer, answer.begin(),
                               [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        if (answer.empty() || answer == "y" || answer == "yes") return true;
        if (answer == "n" || answer == "no") return false;
    }
}

void leave_line() noexcept {
    constexpr std::string_view k_wipe = "\r\x1b[K";
    const OpenLine open = open_line.exchange(OpenLine::none);
    if (open == OpenLine::none) return;
    const std::string_view text = open == OpenLine::bar ? k_wipe : "\n";
    static_cast<void>(::write(STDERR_FILENO, text.data(), text.size()));
}

ProgressBar::ProgressBar(std::string label, bool is_wanted) : label_(std::move(label)) {
    if (!is_wanted || !is_terminal(STDERR_FILENO)) return;
    thread_ = std::thread([this] {
        std::unique_lock lock(mutex_);
        if (end_.wait_for(lock, 500ms, [this] { return ended_; })) return;
        while (!ended_) {
            draw();
            end_.wait_for(lock, 100ms, [this] { return ended_; });
        }
        leave_line();
    });
}

ProgressBar::~ProgressBar() {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }
    end_.notify_all();
    thread_.join();
}

void ProgressBar::update(std::size_t done, std::size_t all) {
    // Threads report out of order; the bar only grows.
    all_.store(all, std::memory_order_relaxed);
    std::size_t before = done_.load(std::memory_order_relaxed);
    while (before < done && !done_.compare_exchange_weak(before, done, std::memory_order_relaxed)) {
    }
}

/// ", 2 min left", if the work takes long enough for that to matter.
std::string ProgressBar::time_left(std::size_t all) const {
    constexpr double k_wait = 3;  // seconds; before that it is a guess
    const std::size_t done = done_;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    if (done == 0 || seconds < k_wait) return "";
    const double left = seconds * static_cast<double>(all - std::min(done, all)) / static_cast<double>(done);
    constexpr double k_minute = 60, k_hour = 3600;
    if (left < 2 * k_minute) return fmt::format(", {:.0f} s left", left);
    return left < 2 * k_hour ? fmt::format(", {:.0f} min left", left / k_minute)
                             : fmt::format(", {:.0f} h left", left / k_hour);
}

void ProgressBar::draw() {
    constexpr std::size_t k_width = 40;
    const std::size_t all = all_;
    if (all == 0) return;
    const std::size_t filled = k_width * done_ / all;
    const std::string bar = std::string(filled, '#') + std::string(k_width - filled, '.');
    open_line = OpenLine::bar;
    std::fputs(
        fmt::format("\r{} [{}] {:3} %{}\x1b[K", label_, bar, 100 * done_ / all, time_left(all)).c_str(),
        stderr);
    std::fflush(stderr);
}
