// A list of numbers as a parameter's value.
#pragma once

#include <utility>
#include <vector>

namespace candela {

/// A class of its own, since libstdc++ 12 takes a variant of nothing but trivial types, strings and vectors
/// for one that always holds something: if copying it runs out of memory, it destroys what was never made.
struct NumberList : std::vector<float> {
    using std::vector<float>::vector;
    NumberList(std::vector<float> numbers) : std::vector<float>(std::move(numbers)) {}
};

}  // namespace candela
