// Requirements for reflection models whose parameters may differ from point to point.
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "batch.h"

import candela.api;
import candela.plugins;

using candela::ParamType;

namespace {

bool may_vary(const candela::Parameter& p) {
    return p.type == ParamType::real || p.type == ParamType::rgb || p.type == ParamType::color;
}

/// Values that agree in everything that cannot vary.
std::vector<Values> sets_of_values() {
    std::vector<Values> all = many_values(6);
    const candela::ParamSet defaults = all.front().set;
    for (Values& values : all) {
        for (std::size_t i = 0; i < defaults.schema().size(); ++i)
            if (!may_vary(defaults.schema()[i])) values.set.set(i, *defaults.get(i));
    }
    return all;
}

/// The parameters of points, each of which has one of the sets in turn.
class Varied {
  public:
    Varied(const std::vector<Values>& sets, std::size_t count) {
        const std::vector<candela::Parameter>& schema = sets.front().set.schema();
        std::vector<std::vector<candela::ParamValue>> runtime;
        for (const Values& values : sets) runtime.push_back(values.set.runtime(candela::ColorEncoding::none));
        for (std::size_t p = 0; p < schema.size(); ++p) {
            const std::size_t channels = schema[p].type == ParamType::real ? 1 : 3;
            for (std::size_t c = 0; may_vary(schema[p]) && c < channels; ++c) {
                std::vector<float>& values = values_.emplace_back();
                for (std::size_t i = 0; i < count; ++i)
                    values.push_back(runtime[i % sets.size()][p].number[c]);
                varying_.push_back({p, c, values.data()});
            }
        }
    }

    const std::vector<candela::VaryingParameter>& all() const { return varying_; }

  private:
    std::vector<std::vector<float>> values_;
    std::vector<candela::VaryingParameter> varying_;
};

}  // namespace

TEST_CASE("varying: a point whose parameters are its own looks as if all points had them", "[reflection]") {
    if (!subject().surface_needs.varying) SKIP("its parameters are the same at each point");
    constexpr std::size_t k_points = 601;  // not only whole passes
    const Arrays in = inputs_for(k_points);
    const std::vector<Values> sets = sets_of_values();
    const Varied varied(sets, k_points);
    const BatchSubject varying = subject_of_varying(sets.front(), varied.all());
    std::vector<BatchSubject> alone;
    for (const Values& values : sets) alone.push_back(batch_subject(values));
    for (std::size_t c = 0; c < varying.calls.size(); ++c) {
        const Call& call = varying.calls[c];
        const Arrays out = outputs_of(call, in);
        for (std::size_t s = 0; s < sets.size(); ++s) {
            const Arrays expected = outputs_of(alone[s].calls[c], in);
            for (std::size_t a = 0; a < out.arrays(); ++a) {
                for (std::size_t i = s; i < k_points; i += sets.size()) {
                    const float x = out[a][i], y = expected[a][i];
                    // Loops over other data round differently.
                    if (!(std::abs(x - y) <= 1e-4f * std::max(std::abs(x), std::abs(y)) + 1e-5f))
                        FAIL(call.name << " returns " << x << " as " << call.outputs[a / 3] << " of point "
                                       << i << " with parameters of its own, and " << y
                                       << " if all points have them, with " << sets[s].text);
                }
            }
        }
    }
}
