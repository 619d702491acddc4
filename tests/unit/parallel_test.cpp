#include <atomic>
#include <catch2/catch_test_macros.hpp>
#include <cstddef>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

import candela.api;
import candela.core;

namespace {

/// The threads that did a hundred pieces of work, and the number of pieces.
struct Done {
    std::set<std::thread::id> threads;
    std::size_t pieces = 0;
};

Done work_through() {
    Done done;
    std::mutex mutex;
    std::atomic<std::size_t> sum{0};
    candela::parallel_for(100, 1, [&](std::size_t begin, std::size_t end) {
        sum += end - begin;
        const std::scoped_lock lock(mutex);
        done.threads.insert(std::this_thread::get_id());
        ++done.pieces;
    });
    CHECK(sum == 100);
    return done;
}

}  // namespace

TEST_CASE("with one thread, work is done in one piece by the calling thread") {
    candela::with_threads(1, [] {
        const Done done = work_through();
        CHECK(done.pieces == 1);
        CHECK(done.threads == std::set{std::this_thread::get_id()});
    });
}

TEST_CASE("with several threads, work is split, even within work of one thread") {
    candela::with_threads(4, [] { CHECK(work_through().pieces == 100); });
    candela::with_threads(1, [] {
        candela::with_threads(4, [] { CHECK(work_through().pieces == 100); });
        CHECK(work_through().pieces == 1);
    });
}

TEST_CASE("an exception from one thread's work does not keep later work from other threads") {
    CHECK_THROWS_AS(candela::with_threads(1, [] { throw std::runtime_error("no"); }), std::runtime_error);
    candela::with_threads(4, [] { CHECK(work_through().pieces == 100); });
}

TEST_CASE("once threads have been started, little work is distributed to all of them as well") {
    candela::with_threads(2, [] { work_through(); });
    const bool has_several = candela::available_threads() > 1;
    candela::with_threads(0, [&] { CHECK((work_through().pieces == 100) == has_several); }, 0.001);
}
