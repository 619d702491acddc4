// A process that evaluates an answer in isolation: it has neither the plugin nor the plugin's results.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "batch.h"
#include "kernel_program.h"

/// The option that turns this program into such a process.
inline constexpr const char* k_compute_option = "--compute-answer";

/// One call: the function, and the parameter values.
struct AnswerCall {
    std::string name;               // "reflect"
    std::vector<float> parameters;  // see kernel_parameters()
    std::size_t arrays = 0;         // of results
};

struct ComputedAnswer {
    int status = 0;              // as from waitpid()
    std::vector<float> numbers;  // of all calls, array by array
};

/// The exit code of a process that cannot load the library; see also k_cannot_be_confined.
inline constexpr int k_cannot_be_loaded = 126;

/// Computes the calls' numbers for all points of `in`, with the library compiled from an answer.
ComputedAnswer computed_answer(const std::filesystem::path& library, const std::vector<AnswerCall>& calls,
                               const Arrays& in);

/// The other side, in its own process.
[[noreturn]] void compute_answer(const char* library);
