// The numbers of a batch, with room around them in which writing is noticed.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fence.h"

import candela.api;
import candela.util;

/// Arrays of equal length, with room before and after each that nobody may write to. Reading there yields
/// NaN.
class Arrays {
  public:
    /// `shift`: the number of floats by which each array is misaligned.
    Arrays(std::size_t arrays, std::size_t count, std::size_t shift = 0);

    float* operator[](std::size_t array) {
        return fenced_.empty() ? data_[array].data() + k_guard + shift_ : fenced_[array]->as<float>();
    }
    const float* operator[](std::size_t array) const {
        return fenced_.empty() ? data_[array].data() + k_guard + shift_ : fenced_[array]->as<float>();
    }
    std::size_t arrays() const { return fenced_.empty() ? data_.size() : fenced_.size(); }
    std::size_t count() const { return count_; }

    candela::Vec3Span vec3(std::size_t first) {
        return {(*this)[first], (*this)[first + 1], (*this)[first + 2]};
    }
    candela::ConstVec3Span vec3(std::size_t first) const {
        return {(*this)[first], (*this)[first + 1], (*this)[first + 2]};
    }
    candela::Vec3 at(std::size_t first, std::size_t i) const { return vec3(first)[i]; }

    void fill(float value);
    /// A copy whose arrays end, or begin, at inaccessible memory, which the copy's own copies share. `name`
    /// names an array in messages about a call that trespasses (fence.h).
    Arrays fenced(Fence fence, const std::function<std::string(std::size_t array)>& name) const;
    /// Fills the arrays with canaries, which only writing removes; is_written() looks for them.
    void fill_with_canary();
    bool is_written(std::size_t array, std::size_t i) const { return !candela::is_canary((*this)[array][i]); }
    /// Elements [first, first + count) of all arrays.
    Arrays part(std::size_t first, std::size_t count, std::size_t shift = 0) const;
    /// "before" or "after" if the room there was written to, otherwise empty. For arrays without a fence.
    std::string trespass() const;
    friend bool operator==(const Arrays& a, const Arrays& b);

  private:
    static constexpr std::size_t k_guard = 64;
    std::size_t count_;
    std::size_t shift_;
    std::vector<std::vector<float>> data_;
    std::vector<std::shared_ptr<Fenced>> fenced_;  // used instead, if there are any
};
