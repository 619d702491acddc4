#include "answer.h"

#include <sys/wait.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
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
#include "answer_process.h"
#include "batch.h"
#include "kernel_program.h"
#include "sandbox.h"

namespace {

constexpr std::size_t k_points = 500;  // per set of values, as for a plugin's own kernel
constexpr int k_random_values = 20;

std::string& answer_text() {
    static std::string text;
    return text;
}

/// One call with one set of values, and the position of the answer's numbers.
struct Trial {
    Call call;
    Values values;
    std::size_t first;  // among all numbers
};

bool is_compared(const Call& call) {
    return call.name != "show_environment" && call.name != "reflect_all_lights";
}

std::vector<Trial> trials_of(std::size_t points) {
    std::vector<Trial> trials;
    std::size_t first = 0;
    for (const Values& values : many_values(k_random_values)) {
        for (const Call& call : batch_subject(values).calls) {
            if (!is_compared(call)) continue;
            trials.push_back({call, values, first});
            first += 3 * call.outputs.size() * points;
        }
    }
    return trials;
}

/// The differences in one term of an answer, over all trials of one call.
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
        const Arrays all_expected = outputs_of(trial.call, in);
        std::size_t differing_numbers = 0;
        for (std::size_t output = 0; output < trial.call.outputs.size(); ++output) {
            const auto actual = [&](std::size_t c, std::size_t i) {
                return numbers[trial.first + (3 * output + c) * in.count() + i];
            };
            const auto expected = [&](std::size_t c, std::size_t i) {
                return all_expected[3 * output + c][i];
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
        // A term that several calls compute is judged by the worst of them.
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
                // Non-finite numbers become null.
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
        // NaN is the worst result of all.
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
    const std::vector<Trial> trials = trials_of(k_points);
    std::vector<AnswerCall> calls;
    for (const Trial& trial : trials)
        calls.push_back({trial.call.name, kernel_parameters(trial.values), 3 * trial.call.outputs.size()});
    limit_compiling();
    try {
        const CompiledKernel compiled(answer_text(), KernelAuthor::anybody);
        const ComputedAnswer answer = computed_answer(compiled.library(), calls, in);
        if (WIFSIGNALED(answer.status)) {
            const int signal = WTERMSIG(answer.status);
            if (signal == SIGXCPU) return {{"hangs", true}};
            const char* const name = ::sigabbrev_np(signal);
            return {{"signal", name == nullptr ? "?" : name}};
        }
        if (WEXITSTATUS(answer.status) == k_cannot_be_loaded) return {{"refused", "it cannot be loaded"}};
        if (WEXITSTATUS(answer.status) != 0) FAIL("this system cannot confine a process: no seccomp filters");
        Judgement judgement;
        for (const Trial& trial : trials) judgement.add(trial, in, answer.numbers);
        return judgement.json();
    } catch (const KernelRefused& problem) {
        return {{"refused", problem.what()}};
    }
}

}  // namespace

void set_answer(std::string text) { answer_text() = std::move(text); }

TEST_CASE("answer: it computes the same numbers as the model", "[answer]") {
    if (candela::plugin_kind_named("reflection") != subject_manifest().kind)
        FAIL("answers are about reflection models; this plugin is not one");
    if (needs_a_file()) FAIL("the model needs a file, which an exercise does not have");
    WARN(judged().dump(-1, ' ', true, nlohmann::json::error_handler_t::replace));
}
