#include "answer.h"

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "agreement.h"
#include "batch.h"
#include "kernel_program.h"
#include "sandbox.h"

namespace {

constexpr std::size_t k_points = 500;  // for each set of values, as for a plugin's own kernel
constexpr int k_random_values = 20;
constexpr std::size_t k_room = 256UL * 1024 * 1024;
constexpr unsigned k_seconds = 3;  // of processor time, for what takes milliseconds

std::string& answer_text() {
    static std::string text;
    return text;
}

/// One call with one set of values: what the model gives, and where the answer's numbers will be.
struct Trial {
    Call call;
    Values values;
    Arrays expected;
    std::size_t first;  // among all numbers
};

bool is_compared(const Call& call) {
    return call.name != "show_surroundings" && call.name != "reflect_punctual";
}

std::vector<Trial> trials_for(const Arrays& in) {
    std::vector<Trial> trials;
    std::size_t first = 0;
    for (const Values& values : many_values(k_random_values)) {
        for (const Call& call : batch_subject(values).calls) {
            if (!is_compared(call)) continue;
            Arrays expected = outputs_of(call, in);
            const std::size_t numbers = expected.arrays() * expected.count();
            trials.push_back({call, values, std::move(expected), first});
            first += numbers;
        }
    }
    return trials;
}

/// Numbers that a child writes and this process reads.
class SharedNumbers {
  public:
    explicit SharedNumbers(std::size_t count)
        : bytes_(count * sizeof(float)),
          at_(::mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
        if (at_ == MAP_FAILED) FAIL("no memory is left: " << std::strerror(errno));
    }
    SharedNumbers(const SharedNumbers&) = delete;
    SharedNumbers& operator=(const SharedNumbers&) = delete;
    ~SharedNumbers() { ::munmap(at_, bytes_); }
    std::span<float> all() const { return {static_cast<float*>(at_), bytes_ / sizeof(float)}; }

  private:
    std::size_t bytes_;
    void* at_;
};

/// In a child that may do nothing but compute. Its status, as waitpid() says it.
int run_confined(const KernelProgram& program, const std::vector<Trial>& trials, const Arrays& in,
                 std::span<float> numbers) {
    const pid_t child = ::fork();
    if (child < 0) FAIL("no process can be started: " << std::strerror(errno));
    if (child == 0) {
        for (const int signal : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT}) ::signal(signal, SIG_DFL);
        confine(k_room, k_seconds);
        for (const Trial& trial : trials) {
            Arrays actual(trial.expected.arrays(), in.count());
            program.run(trial.call.name, trial.values, 0, in, actual);
            for (std::size_t a = 0; a < actual.arrays(); ++a)
                std::copy_n(actual[a], in.count(),
                            numbers.subspan(trial.first + a * in.count(), in.count()).data());
        }
        ::_exit(0);
    }
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

/// How a term of an answer differs, over all trials of one call.
struct TermDifference {
    std::size_t differing = 0, points = 0;
    double largest = -1;
    float expected = 0, actual = 0;
    std::string at, with;

    double share() const {
        return points == 0 ? 0 : static_cast<double>(differing) / static_cast<double>(points);
    }
};

class Judgement {
  public:
    void add(const Trial& trial, const Arrays& in, std::span<const float> numbers) {
        std::size_t differing_numbers = 0;
        for (std::size_t output = 0; output < trial.call.outputs.size(); ++output) {
            const auto actual = [&](std::size_t c, std::size_t i) {
                return numbers[trial.first + (3 * output + c) * in.count() + i];
            };
            const auto expected = [&](std::size_t c, std::size_t i) {
                return trial.expected[3 * output + c][i];
            };
            float peak = 0;
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t i = 0; i < in.count(); ++i) peak = std::max(peak, std::abs(expected(c, i)));
            TermDifference& term = terms_[{trial.call.outputs[output], trial.call.name}];
            term.points += in.count();
            for (std::size_t i = 0; i < in.count(); ++i) {
                const float largest =
                    std::max({std::abs(expected(0, i)), std::abs(expected(1, i)), std::abs(expected(2, i))});
                bool differs = false;
                for (std::size_t c = 0; c < 3; ++c) {
                    if (agree(expected(c, i), actual(c, i), largest)) continue;
                    differs = true;
                    ++differing_numbers;
                    note(term, trial, in, i, expected(c, i), actual(c, i), peak);
                }
                if (differs) ++term.differing;
            }
        }
        matches_ = matches_ &&
                   static_cast<double>(differing_numbers) <= k_may_differ * static_cast<double>(in.count());
    }

    nlohmann::json json() const {
        // A term that several calls give is as wrong as it is in the worst of them.
        std::map<std::string, const TermDifference*> worst;
        std::size_t points = 0;
        for (const auto& [key, term] : terms_) {
            const TermDifference*& one = worst[key.first];
            if (one == nullptr || one->share() < term.share()) one = &term;
            points = std::max(points, term.points);
        }
        nlohmann::json terms = nlohmann::json::array();
        for (const auto& [name, term] : worst) {
            nlohmann::json one = {{"term", name}, {"share", term->share()}};
            if (term->differing > 0) {
                // What is not finite becomes null.
                one.update({{"largest", term->largest},
                            {"expected", term->expected},
                            {"actual", term->actual},
                            {"at", term->at},
                            {"with", term->with}});
            }
            terms.push_back(std::move(one));
        }
        return {{"matches", matches_}, {"points", points}, {"terms", std::move(terms)}};
    }

  private:
    static void note(TermDifference& term, const Trial& trial, const Arrays& in, std::size_t i,
                     float expected, float actual, float peak) {
        const double difference = std::abs(static_cast<double>(expected) - static_cast<double>(actual)) /
                                  (peak > 0 ? static_cast<double>(peak) : 1.0);
        // Not a number is the worst there is.
        if (!std::isfinite(term.largest) || (std::isfinite(difference) && difference <= term.largest)) return;
        term.largest = difference;
        term.expected = expected;
        term.actual = actual;
        term.at = text_of_input(in, i);
        term.with = trial.values.text;
    }

    std::map<std::pair<std::string, std::string>, TermDifference> terms_;
    bool matches_ = true;
};

nlohmann::json judged() {
    const Arrays in = inputs_for(k_points);
    const std::vector<Trial> trials = trials_for(in);
    limit_compiling();
    std::size_t count = 0;
    for (const Trial& trial : trials) count += trial.expected.arrays() * trial.expected.count();
    try {
        const KernelProgram program(answer_text());
        const SharedNumbers numbers(count);
        const int status = run_confined(program, trials, in, numbers.all());
        if (WIFSIGNALED(status)) {
            const int signal = WTERMSIG(status);
            if (signal == SIGXCPU) return {{"hangs", true}};
            const char* const name = ::sigabbrev_np(signal);
            return {{"signal", name == nullptr ? "?" : name}};
        }
        if (WEXITSTATUS(status) != 0) FAIL("this system cannot confine a process: no seccomp filters");
        Judgement judgement;
        for (const Trial& trial : trials) judgement.add(trial, in, numbers.all());
        return judgement.json();
    } catch (const KernelRefused& problem) {
        return {{"refused", problem.what()}};
    }
}

}  // namespace

void set_answer(std::string text) { answer_text() = std::move(text); }

TEST_CASE("answer: it gives the numbers that the model gives", "[answer]") {
    if (candela::plugin_kind_named("reflection") != subject_manifest().kind)
        FAIL("answers are about reflection models; this is another plugin");
    if (needs_a_file()) FAIL("the model needs a file, which an exercise has not");
    WARN(judged().dump(-1, ' ', true, nlohmann::json::error_handler_t::replace));
}
