#include "arrays.h"

#include <algorithm>
#include <cstring>
#include <span>

Arrays::Arrays(std::size_t arrays, std::size_t count, std::size_t shift)
    : count_(count), shift_(shift), data_(arrays, std::vector<float>(2 * k_guard + count + shift)) {
    for (std::vector<float>& array : data_) candela::fill_with_canary(array);
    fill(0);
}

void Arrays::fill(float value) {
    for (std::size_t a = 0; a < arrays(); ++a) std::fill_n((*this)[a], count_, value);
}

void Arrays::fill_with_canary() {
    for (std::size_t a = 0; a < arrays(); ++a) candela::fill_with_canary({(*this)[a], count_});
}

Arrays Arrays::fenced(Fence fence, const std::function<std::string(std::size_t)>& name) const {
    Arrays result(0, count_);
    for (std::size_t a = 0; a < arrays(); ++a) {
        result.fenced_.push_back(std::make_shared<Fenced>(name(a), count_ * sizeof(float), fence));
        std::copy_n((*this)[a], count_, result.fenced_.back()->as<float>());
    }
    return result;
}

Arrays Arrays::part(std::size_t first, std::size_t count, std::size_t shift) const {
    Arrays result(arrays(), count, shift);
    for (std::size_t a = 0; a < arrays(); ++a) std::copy_n((*this)[a] + first, count, result[a]);
    return result;
}

std::string Arrays::trespass() const {
    for (const std::span<const float> array : data_) {
        if (!candela::is_canary_intact(array.first(k_guard + shift_))) return "before";
        if (!candela::is_canary_intact(array.subspan(k_guard + shift_ + count_))) return "after";
    }
    return {};
}

bool operator==(const Arrays& a, const Arrays& b) {
    if (a.arrays() != b.arrays() || a.count() != b.count()) return false;
    for (std::size_t i = 0; i < a.arrays(); ++i) {
        if (std::memcmp(a[i], b[i], a.count() * sizeof(float)) != 0) return false;
    }
    return true;
}
