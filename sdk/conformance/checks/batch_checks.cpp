// Requirements for all plugins that work on batches.
#include "batch.h"

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "at_once.h"

using candela::Vec3;

namespace {

constexpr double k_may_be_at_edges = 0.02;

/// Finds the first non-finite result.
void require_finite(const Call& call, const Values& values, const Arrays& in, const Arrays& out) {
    for (std::size_t a = 0; a < out.arrays(); ++a) {
        for (std::size_t i = 0; i < out.count(); ++i) {
            const float x = out[a][i];
            if (!out.is_written(a, i)) continue;  // reported by "written"
            if (!std::isfinite(x))
                FAIL(call.name << " returns " << x << " as " << call.outputs[a / 3] << ", for "
                               << text_of_input(in, i) << ", with " << values.text);
            if (x < 0 && !call.may_be_negative && call.outputs[a / 3] != "to_light")
                FAIL(call.name << " returns a negative " << call.outputs[a / 3] << ", " << x << ", for "
                               << text_of_input(in, i) << ", with " << values.text);
        }
    }
}

bool close(float a, float b) {
    // Wide and narrow versions of one loop round differently.
    return std::abs(a - b) <= 1e-5f * std::max(std::abs(a), std::abs(b)) + 1e-6f;
}

/// Finds the first position at which two results differ by more than rounding.
void require_close(const Call& call, const Arrays& a, const Arrays& b, std::size_t first,
                   const std::string& when) {
    for (std::size_t k = 0; k < b.arrays(); ++k) {
        for (std::size_t i = 0; i < b.count(); ++i) {
            if (!close(a[k][first + i], b[k][i]))
                FAIL(call.name << " returns " << b[k][i] << " as " << call.outputs[k / 3] << " of point " << i
                               << " " << when << ", and " << a[k][first + i] << " otherwise");
        }
    }
}

/// Inputs that end, or begin, at inaccessible memory, named as the calls name them. Mapping that memory takes
/// far longer than a call, so all calls share it.
class FencedInputs {
  public:
    explicit FencedInputs(const Arrays& in) : in_(in) {}

    const Arrays& at(Fence fence, const Call& call) {
        const auto of_call = std::pair(fence, call.name.substr(0, call.name.find(' ')));
        const auto known = fenced_.find(of_call);
        if (known != fenced_.end()) return known->second;
        const auto name = [&](std::size_t array) { return name_of_input(call, array); };
        return fenced_.emplace(of_call, in_.fenced(fence, name)).first->second;
    }

  private:
    const Arrays& in_;
    std::map<std::pair<Fence, std::string>, Arrays> fenced_;
};

void require_no_trespass(const Call& call, FencedInputs& inputs, std::size_t count) {
    const auto output = [&](std::size_t array) {
        return fmt::format("{}.{}", call.outputs[array / 3], "xyz"[array % 3]);
    };
    for (const Fence fence : {Fence::after, Fence::before}) {
        const Arrays& given = inputs.at(fence, call);
        Arrays out = Arrays(3 * call.outputs.size(), count).fenced(fence, output);
        const std::string trespass = trespass_of([&] { call.run(count, given, out); });
        if (!trespass.empty()) FAIL(call.name << " " << trespass << ", in a batch of " << count << " points");
    }
}

/// The shortest of several rounds of calls.
double milliseconds(const Call& call, const Arrays& in, int rounds) {
    Arrays out(3 * call.outputs.size(), in.count());
    double best = std::numeric_limits<double>::infinity();
    for (int round = 0; round < rounds; ++round) {
        const auto begin = std::chrono::steady_clock::now();
        for (int i = 0; i < 20; ++i) call.run(in.count(), in, out);
        best = std::min(
            best,
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
    }
    return best;
}

}  // namespace

TEST_CASE(
    "finite: no result is NaN, infinite or below zero, for the bounds of each parameter and 50 random sets",
    "[light][reflection][shading]") {
    const Arrays random = inputs_for(512), aligned = aligned_inputs();
    for (const Values& values : many_values()) {
        for (const Call& call : batch_subject(values).calls) {
            for (const Arrays* const in : {&random, &aligned})
                require_finite(call, values, *in, outputs_of(call, *in));
        }
    }
}

TEST_CASE("written: a light or shading model writes every result, for every point", "[light][shading]") {
    const Arrays in = inputs_for(257);
    for (const Values& values : many_values(4)) {
        for (const Call& call : batch_subject(values).calls) {
            const Arrays out = outputs_of(call, in);
            for (std::size_t a = 0; a < out.arrays(); ++a) {
                for (std::size_t i = 0; i < out.count(); ++i) {
                    if (!out.is_written(a, i))
                        FAIL(call.name << " does not write the " << call.outputs[a / 3] << " of point " << i
                                       << " of " << out.count() << ", with " << values.text);
                }
            }
        }
    }
}

TEST_CASE(
    "batches: any number of points, at any address, yields the same results as the points one at a time",
    "[light][reflection][shading]") {
    const Arrays in = inputs_for(2027);
    for (const Values& values : many_values(4)) {
        for (const Call& call : batch_subject(values).calls) {
            const Arrays whole = outputs_of(call, in);
            for (const std::size_t count :
                 {std::size_t{7}, std::size_t{64}, std::size_t{1000}, std::size_t{1024}, std::size_t{2027}}) {
                const Arrays some = in.part(0, count);
                require_close(call, whole, outputs_of(call, some), 0,
                              "in a batch of " + std::to_string(count));
            }
            for (std::size_t i = 0; i < 40; ++i)
                require_close(call, whole, outputs_of(call, in.part(i, 1)), i, "alone");
            for (const std::size_t shift : {std::size_t{1}, std::size_t{3}, std::size_t{7}})
                require_close(call, whole, outputs_of(call, in.part(0, 333, shift), shift), 0,
                              "in arrays that begin at an odd address");
        }
    }
}

TEST_CASE("bounds: nothing is read or written before or after the batch, and no input is changed",
          "[light][reflection][shading]") {
    std::vector<BatchSubject> subjects;
    for (const Values& values : many_values(4)) subjects.push_back(batch_subject(values));
    for (const std::size_t count : {std::size_t{1}, std::size_t{7}, std::size_t{16}, std::size_t{257}}) {
        const Arrays in = inputs_for(count);
        const Arrays given = in.part(0, count);
        FencedInputs fenced(in);
        for (const BatchSubject& subject : subjects) {
            for (const Call& call : subject.calls) {
                Arrays out(3 * call.outputs.size(), count);
                call.run(count, given, out);
                if (const std::string where = out.trespass(); !where.empty())
                    FAIL(call.name << " writes " << where << " a batch of " << count << " points");
                if (!given.trespass().empty() || !(given == in))
                    FAIL(call.name << " changes its inputs, in a batch of " << count << " points");
                require_no_trespass(call, fenced, count);
            }
        }
    }
}

TEST_CASE("adding: a reflection model adds to the existing values, and leaves the other parts unchanged",
          "[reflection]") {
    const Arrays in = inputs_for(64);
    for (const Call& call : batch_subject(default_values()).calls) {
        if (!call.adds) continue;
        const Arrays from_zero = outputs_of(call, in);
        Arrays from_one(9, 64);
        from_one.fill(1);
        call.run(64, in, from_one);
        for (std::size_t a = 0; a < 9; ++a) {
            for (std::size_t i = 0; i < 64; ++i) {
                if (!close(from_zero[a][i] + 1, from_one[a][i]))
                    FAIL(call.name << " does not add to the " << call.outputs[a / 3]
                                   << " that is already there: " << from_one[a][i] << " where 1 + "
                                   << from_zero[a][i] << " would be right, for " << text_of_input(in, i));
            }
        }
    }
}

TEST_CASE("repeatable: the same input yields the same bytes, again and from 8 threads at once",
          "[light][reflection][shading]") {
    // Threads with equal work would not notice that they share memory, so each has its own; and they switch
    // often, between small batches like a renderer's.
    constexpr std::size_t k_threads = 8, k_points = 256;
    constexpr int k_rounds = 60, k_creations = 10;
    constexpr auto k_longest = std::chrono::milliseconds(500), k_longest_in_all = 20 * k_longest;
    const auto end = std::chrono::steady_clock::now() + k_longest_in_all;
    std::vector<Arrays> in;
    for (unsigned seed = 0; seed < k_threads; ++seed) in.push_back(inputs_for(k_points, 20 + seed));
    for (const Values& values : many_values(2)) {
        const BatchSubject subject = batch_subject(values);
        for (const Call& call : subject.calls) {
            std::vector<Arrays> first;
            for (const Arrays& own : in) {
                first.push_back(outputs_of(call, own));
                if (!(outputs_of(call, own) == first.back()))
                    FAIL(call.name << " returns a different result the second time, with " << values.text);
            }
            if (!hold_at_once(k_threads, k_rounds,
                              std::min(std::chrono::steady_clock::now() + k_longest, end),
                              [&](std::size_t t) { return outputs_of(call, in[t]) == first[t]; }))
                FAIL(call.name << " returns a different result when 8 threads call it at once, with "
                               << values.text);
        }
        // Instances are also created in any thread.
        const auto result_of_new = [&](std::size_t t) {
            return outputs_of(batch_subject(values).calls.front(), in[t]);
        };
        std::vector<Arrays> alone;
        for (std::size_t t = 0; t < k_threads; ++t) alone.push_back(result_of_new(t));
        if (!hold_at_once(k_threads, k_creations, std::chrono::steady_clock::now(),
                          [&](std::size_t t) { return result_of_new(t) == alone[t]; }))
            FAIL("instances that 8 threads create at once return different results, with " << values.text);
    }
}

TEST_CASE("frame: in a rotated world, a surface looks the same", "[reflection][shading]") {
    if (declares("fixed-in-world")) SKIP("it declares fixed-in-world");
    const bool is_shading = subject_manifest().kind == candela::PluginKind::shading;
    const Arrays in = inputs_for(500), in_turned = turned(in);
    for (const Values& values : many_values(6)) {
        for (const Call& call : batch_subject(values).calls) {
            // The kit's surroundings have another colour in every direction, and its lamps stay where they
            // are.
            if (call.name == "show_environment" || call.name == "reflect_all_lights") continue;
            const Arrays out = outputs_of(call, in), out_turned = outputs_of(call, in_turned);
            std::size_t differing = 0, first = 0;
            for (std::size_t i = 0; i < in.count(); ++i) {
                float off = 0, size = 0;
                for (std::size_t part = 0; part < out.arrays(); part += 3) {
                    const Vec3 expected = is_shading ? turned(out.at(part, i)) : out.at(part, i);
                    off = std::max(off, candela::length(out_turned.at(part, i) - expected));
                    size = std::max(size, candela::length(expected));
                }
                if (off <= 5e-3f * size + 1e-5f) continue;
                if (differing++ == 0) first = i;
            }
            // At a discontinuity of a model, the last bit decides on which side a point is.
            if (static_cast<double>(differing) > k_may_be_at_edges * static_cast<double>(in.count()))
                FAIL(call.name << " depends on the world's axes: with all vectors rotated, " << differing
                               << " of " << in.count() << " results differ, the first for "
                               << text_of_input(in, first) << ", with " << values.text);
        }
    }
}

TEST_CASE("independent: an instance does not depend on others made before, after or destroyed",
          "[light][reflection][shading]") {
    const Arrays in = inputs_for(100);
    const std::vector<Values> all = many_values(6);
    std::vector<BatchSubject> subjects;
    std::vector<std::vector<Arrays>> alone;
    for (const Values& values : all) {
        const BatchSubject subject = batch_subject(values);
        std::vector<Arrays>& results = alone.emplace_back();
        for (const Call& call : subject.calls) results.push_back(outputs_of(call, in));
    }
    for (const Values& values : all) subjects.push_back(batch_subject(values));
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t c = 0; c < subjects[i].calls.size(); ++c) {
            if (!(outputs_of(subjects[i].calls[c], in) == alone[i][c]))
                FAIL(subjects[i].calls[c].name << " returns another result while other instances exist, with "
                                               << all[i].text);
        }
    }
}

#ifdef __SSE2__
TEST_CASE("speed: it produces no denormal numbers, which are slow", "[light][reflection][shading]") {
    const Arrays in = inputs_for(1024);
    const unsigned usual_mode = _mm_getcsr();
    constexpr unsigned k_flush_to_zero = 0x8000, k_denormals_are_zero = 0x0040;
    constexpr double k_much_longer = 2;
    const auto ratio = [&](const Call& call, int rounds) {
        const double usual = milliseconds(call, in, rounds);
        _mm_setcsr(usual_mode | k_flush_to_zero | k_denormals_are_zero);
        const double flushed = milliseconds(call, in, rounds);
        _mm_setcsr(usual_mode);
        return usual / flushed;
    };
    for (const Values& values : many_values(8)) {
        for (const Call& call : batch_subject(values).calls) {
            // A seemingly slow call may have been interrupted, so it is measured again for longer.
            if (ratio(call, 4) <= k_much_longer) continue;
            const double slower = ratio(call, 20);
            if (slower > k_much_longer) {
                WARN(call.name << " takes " << slower
                               << " times as long as without denormal numbers, which are products of small "
                                  "factors; make such factors zero, as clamped_power() does, or as in x > "
                                  "1.0e-20f ? x : 0.0f, with "
                               << values.text);
                return;
            }
        }
    }
}
#endif
