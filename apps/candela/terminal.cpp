#include "terminal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>

namespace {

using namespace std::chrono_literals;

bool is_terminal(int descriptor) { return ::isatty(descriptor) == 1; }

}  // namespace

bool stderr_takes_color() {
    const char* const no_color = std::getenv("NO_COLOR");
    const char* const term = std::getenv("TERM");
    return is_terminal(STDERR_FILENO) && (no_color == nullptr || *no_color == '\0') &&
           (term == nullptr || std::string(term) != "dumb");
}

bool can_ask() { return is_terminal(STDIN_FILENO) && is_terminal(STDERR_FILENO); }

bool ask(const std::string& question) {
    for (const char* before = "";; before = "Please answer y or n. ") {
        std::cerr << before << question << " [Y/n] " << std::flush;
        std::string answer;
        if (!std::getline(std::cin, answer)) {
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

ProgressBar::ProgressBar(std::string label) : label_(std::move(label)) {
    if (!is_terminal(STDERR_FILENO)) return;
    thread_ = std::thread([this] {
        std::unique_lock lock(mutex_);
        if (end_.wait_for(lock, 500ms, [this] { return ended_; })) return;
        while (!ended_) {
            draw();
            end_.wait_for(lock, 100ms, [this] { return ended_; });
        }
        if (drawn_) std::fputs("\r\x1b[K", stderr);
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

void ProgressBar::draw() {
    constexpr std::size_t k_width = 40;
    const std::size_t all = all_;
    if (all == 0) return;
    const std::size_t filled = k_width * done_ / all;
    const std::string bar = std::string(filled, '#') + std::string(k_width - filled, '.');
    std::fputs(fmt::format("\r{} [{}] {:3} %", label_, bar, 100 * done_ / all).c_str(), stderr);
    std::fflush(stderr);
    drawn_ = true;
}
