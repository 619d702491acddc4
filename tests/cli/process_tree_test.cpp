// Ends all child processes while others are being started.
#include <catch2/catch_test_macros.hpp>

#include <spawn.h>
#include <sys/types.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <future>
#include <string>
#include <thread>
#include <vector>

#include "sandbox/process_tree.h"

namespace {

/// A program that does not end by itself.
pid_t start_sleeper() {
    std::string name = "sleep", time = "1000";
    char* const words[] = {name.data(), time.data(), nullptr};
    pid_t process = -1;
    REQUIRE(::posix_spawnp(&process, "sleep", nullptr, nullptr, words, environ) == 0);
    return process;
}

bool is_gone(pid_t process) { return ::kill(process, 0) != 0 && errno == ESRCH; }

}  // namespace

TEST_CASE("all programs are ended, without waiting for those that another thread starts meanwhile") {
    std::vector<pid_t> started;
    std::atomic<bool> is_over = false;
    std::future<void> ending = std::async(std::launch::async, [&] {
        while (!is_over) end_descendants();
        end_descendants();
    });
    for (int i = 0; i < 300; ++i) {
        started.push_back(start_sleeper());
        std::this_thread::sleep_for(std::chrono::microseconds(i % 7 * 100));
    }
    is_over = true;
    const bool is_ended = ending.wait_for(std::chrono::seconds(60)) == std::future_status::ready;
    if (!is_ended)
        for (const pid_t process : started)
            ::kill(process, SIGKILL);  // otherwise the test would wait for them
    CHECK(is_ended);
    ending.wait();
    for (const pid_t process : started) CHECK(is_gone(process));
}
