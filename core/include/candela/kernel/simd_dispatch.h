// One batch loop, compiled for every instruction set and dispatched at run time.
//
//     struct AddLoop {
//         CANDELA_BATCH_LOOP static void run(std::size_t count, const float* a, float* sum) {
//             CANDELA_VECTORIZE
//             for (std::size_t i = 0; i < count; ++i) sum[i] += a[i];
//         }
//     };
//     candela::multiversion<AddLoop>(count, a, sum);
//
// Everything the loop calls must be inlined into it; otherwise it is neither vectorised nor compiled for the
// wider set. clang warns if a CANDELA_VECTORIZE loop remains scalar. Mark what it calls
// [[gnu::always_inline]]. A lambda cannot be marked before C++23, and without optimisation its results may
// round differently.
//
// CANDELA_VECTORIZE_CHAIN is for a loop whose body is one long chain of dependent operations, such as pow:
// interleaving two vectors keeps the processor busy where one would wait for itself. A loop with enough
// independent work only loses registers to it.
//
// CANDELA_VECTORIZE_FOUR is for such a chain whose iteration count is nearly always a multiple of 64: it
// interleaves four vectors. Fewer iterations take longer than with two.
//
// CANDELA_VECTORIZE_SIXTEEN is for a loop of sixteen iterations inside another. Such a loop would otherwise
// be unrolled before it can be vectorised, or run as a few iterations of narrower vectors.
#pragma once

#include "candela/plugin/export.h"

#define CANDELA_BATCH_LOOP [[gnu::always_inline]]

#if defined(__clang__)
#define CANDELA_VECTORIZE _Pragma("clang loop vectorize(assume_safety)")
#define CANDELA_VECTORIZE_CHAIN _Pragma("clang loop vectorize(assume_safety) interleave_count(2)")
#define CANDELA_VECTORIZE_FOUR _Pragma("clang loop vectorize(assume_safety) interleave_count(4)")
#define CANDELA_VECTORIZE_SIXTEEN \
    _Pragma("clang loop vectorize(assume_safety) vectorize_width(16) unroll(disable)")
#else
#define CANDELA_VECTORIZE _Pragma("GCC ivdep")
#define CANDELA_VECTORIZE_CHAIN CANDELA_VECTORIZE
#define CANDELA_VECTORIZE_FOUR CANDELA_VECTORIZE
#define CANDELA_VECTORIZE_SIXTEEN CANDELA_VECTORIZE
#endif

// Tunes clang's code for processors with fast gathers: otherwise it reads table entries and indexed values
// one by one. g++ inlines into a function tuned for another processor only what is marked always_inline; the
// copy constructors of kernels' structs are not, and calling them would keep every loop scalar.
#if defined(__clang__)
#define CANDELA_TARGET_AVX2 "arch=x86-64-v3,tune=skylake"
#else
#define CANDELA_TARGET_AVX2 "arch=x86-64-v3"
#endif

namespace candela {

/// candela::instruction_set() as a number, for headers, which cannot import modules: 0 baseline, 1 AVX2, 2
/// AVX-512.
CANDELA_EXPORT int instruction_set_level() noexcept;

/// The versions of one loop. Not inlined, so that each can be found by name in a profile and in the
/// compiler's optimisation records.
template <class Loop, class... Arguments>
struct Multiversion {
    [[gnu::noinline]] static void baseline(const Arguments&... arguments) { Loop::run(arguments...); }
#if defined(__x86_64__)
    [[gnu::noinline, gnu::target(CANDELA_TARGET_AVX2)]] static void avx2(const Arguments&... arguments) {
        Loop::run(arguments...);
    }
    [[gnu::noinline, gnu::target("arch=x86-64-v4")]] static void avx512(const Arguments&... arguments) {
        Loop::run(arguments...);
    }
#endif
};

/// Runs `Loop::run(arguments...)` with the instruction set in use. Arguments are taken by const reference; a
/// loop copies what it reads into locals or takes it by value, so that the compiler knows that its stores do
/// not change it.
template <class Loop, class... Arguments>
inline void multiversion(const Arguments&... arguments) {
    using Versions = Multiversion<Loop, Arguments...>;
#if defined(__x86_64__)
    switch (instruction_set_level()) {
        case 2:
            return Versions::avx512(arguments...);
        case 1:
            return Versions::avx2(arguments...);
        default:
            break;
    }
#endif
    Versions::baseline(arguments...);
}

}  // namespace candela
