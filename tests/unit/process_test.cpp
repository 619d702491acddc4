// Child processes: what they inherit, how they answer line by line, and how they end.
#include <fcntl.h>
#include <unistd.h>

#include <catch2/catch_test_macros.hpp>
#include <chrono>
#include <csignal>
#include <memory>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "process/process.h"

import candela.util;

using candela::AnsweringProgram;
using std::chrono::milliseconds;

namespace {

constexpr milliseconds k_patience{60000};

}  // namespace

TEST_CASE("a program inherits its three streams, and no open file or socket, however it is started") {
    // Any code may have forgotten O_CLOEXEC.
    const int file = ::open("/dev/null", O_RDONLY);
    const int another = ::fcntl(file, F_DUPFD, 700);
    REQUIRE(another >= 700);
    // The last one is the folder that `ls` itself reads.
    const std::string list = "echo $(ls /proc/self/fd)";
    CHECK(candela::run_program({"/bin/sh", "-c", list}).out == "0 1 2 3\n");
    AnsweringProgram answering({"/bin/sh", "-c", "read line; " + list});
    CHECK(answering.answer("go on", k_patience) == "0 1 2 3");
    candela::WaitingProgram waiting({"/bin/sh", "-c", "read line; " + list});
    const auto waited = waiting.go_on();
    REQUIRE(waited.has_value());
    CHECK(waited->out == "0 1 2 3\n");
    CHECK(candela::show_program({"/bin/sh", "-c", "[ \"$(" + list + ")\" = '0 1 2 3' ]"}) == 0);
    ::close(file);
    ::close(another);
}

TEST_CASE("a program that takes too long, or is no longer wanted, is ended") {
    const std::vector<std::string> long_work{"/bin/sleep", "100000"};
    const candela::ProgramOutput late = candela::run_program(long_work, {.longest = milliseconds(20)});
    CHECK(late.end == candela::ProgramEnd::late);
    CHECK(late.exit_code == 128 + SIGTERM);

    std::stop_source source;
    std::thread leaving([&] {
        std::this_thread::sleep_for(milliseconds(20));
        source.request_stop();
    });
    const candela::ProgramOutput unwanted = candela::run_program(long_work, {.unwanted = source.get_token()});
    leaving.join();
    CHECK(unwanted.end == candela::ProgramEnd::unwanted);
    CHECK(unwanted.exit_code == 128 + SIGTERM);

    const candela::ProgramOutput deaf =
        candela::run_program({"/bin/sh", "-c", "trap '' TERM; while :; do read line < /dev/null; done"},
                             {.longest = milliseconds(20)});
    CHECK(deaf.end == candela::ProgramEnd::late);
    CHECK(deaf.exit_code == 128 + SIGKILL);

    candela::WaitingProgram told({"/bin/sh", "-c", "read line; echo begun; exec sleep 100000"});
    const auto given_up = told.go_on({.longest = milliseconds(100)});
    REQUIRE(given_up.has_value());
    CHECK(given_up->end == candela::ProgramEnd::late);
    CHECK(given_up->exit_code == 128 + SIGTERM);

    const candela::ProgramOutput quick = candela::run_program(
        {"/bin/echo", "said"}, {.longest = k_patience, .unwanted = std::stop_source().get_token()});
    CHECK(quick.end == candela::ProgramEnd::own);
    CHECK(quick.out == "said\n");
}

TEST_CASE("a program answers line by line, however long the lines are") {
    AnsweringProgram cat({"/bin/cat"});
    CHECK(cat.answer("one", k_patience) == "one");
    CHECK(cat.answer("", k_patience) == "");
    const std::string large(100'000, 'x');
    CHECK(cat.answer(large, k_patience) == large);
    CHECK(cat.errors().empty());
}

TEST_CASE("a program that ends, or is sent a line after its end, gives no answer, and its errors are kept") {
    AnsweringProgram shell({"/bin/sh", "-c", "read line; echo \"not $line\" >&2; exit 3"});
    CHECK_FALSE(shell.answer("this", k_patience).has_value());
    CHECK(shell.errors() == "not this\n");
    CHECK_FALSE(shell.answer("that", k_patience).has_value());
}

TEST_CASE("waiting for a program that does not answer ends in time, and ends the program") {
    AnsweringProgram deaf({"/bin/sh", "-c", "trap '' TERM; while :; do sleep 0.01; done"});
    CHECK_FALSE(deaf.answer("hello?", milliseconds(20)).has_value());
}

TEST_CASE("a missing program cannot answer") {
    CHECK_THROWS_AS(AnsweringProgram({"/nowhere/at/all"}), candela::Error);
}

TEST_CASE("programs started at the same moment do not wait for one another's end") {
    // Pipes inherited from one another would stay open until the heirs' end.
    constexpr int k_rounds = 60;
    std::vector<std::unique_ptr<AnsweringProgram>> patient;
    std::thread starting([&] {
        for (int i = 0; i < k_rounds; ++i)
            patient.push_back(std::make_unique<AnsweringProgram>(std::vector<std::string>{"/bin/cat"}));
    });
    for (int i = 0; i < k_rounds; ++i) CHECK(candela::run_program({"/bin/echo", "said"}).out == "said\n");
    starting.join();
    for (const auto& cat : patient) CHECK(cat->answer("still there", k_patience) == "still there");
}

TEST_CASE("a program waits until it is told to continue, and then everything that it prints is available") {
    candela::WaitingProgram shell(
        {"/bin/sh", "-c", "read line; head -c 1000000 /dev/zero | tr '\\0' x; echo so >&2; exit 3"});
    const auto result = shell.go_on();
    REQUIRE(result.has_value());
    CHECK(result->exit_code == 3);
    CHECK((result->out == std::string(1'000'000, 'x')));
    CHECK(result->err == "so\n");
}

TEST_CASE("a program that ended before it was told to continue yields nothing, and one that waits is ended") {
    {
        candela::WaitingProgram impatient({"/bin/true"});
        // Its end of the connection is closed by then.
        std::this_thread::sleep_for(milliseconds(500));
        CHECK_FALSE(impatient.go_on().has_value());
    }
    const candela::WaitingProgram patient({"/bin/cat"});
}
