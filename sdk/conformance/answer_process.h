// A process that computes with an answer and knows nothing else: it has neither the plugin nor what the
// plugin gives.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "batch.h"
#include "kernel_program.h"

/// The option by which this program becomes such a process.
inline constexpr const char* k_compute_option = "--compute-answer";

/// One call: what is asked for, and for which values.
struct AnswerCall {
    std::string name;  // "reflect"
    KernelInputs inputs;
    std::size_t arrays = 0;  // of results
};

struct ComputedAnswer {
    int status = 0;              // as waitpid() says it
    std::vector<float> numbers;  // of all calls, array by array
};

/// The exit code of a process that cannot load the library; see also k_cannot_be_confined.
inline constexpr int k_cannot_be_loaded = 126;

/// Has the calls' numbers computed by the library that an answer has become, for all points of `in`.
ComputedAnswer computed_answer(const std::filesystem::path& library, const std::vector<AnswerCall>& calls,
                               const Arrays& in);

/// The other side, in a process of its own.
[[noreturn]] void compute_answer(const char* library);
