#include "candela/target/arrays.h"

#include <fmt/format.h>

#include <type_traits>

#include "candela/target/literals.h"

namespace candela::target {

namespace {

template <class T>
std::string array_text(const char* type, const char* name, std::span<const T> numbers) {
    std::string text = fmt::format("    static const {} {}[] = {{", type, name);
    std::size_t column = 200;  // the first number begins a line
    for (const T& number : numbers) {
        std::string word;
        if constexpr (std::is_same_v<T, float>) {
            word = float_text(number) + ",";
        } else {
            word = fmt::format("{},", number);
        }
        const bool is_full = column + word.size() > 116;
        if (is_full) column = 8;
        text += (is_full ? "\n        " : " ") + word;
        column += word.size() + 1;
    }
    return text + "\n    };\n";
}

}  // namespace

std::vector<float> interleaved(ConstVec3Span arrays, std::size_t count) {
    std::vector<float> numbers;
    if (!arrays) return numbers;
    numbers.resize(3 * count);
    for (std::size_t i = 0; i < count; ++i) {
        numbers[3 * i] = arrays.x[i];
        numbers[3 * i + 1] = arrays.y[i];
        numbers[3 * i + 2] = arrays.z[i];
    }
    return numbers;
}

std::vector<float> interleaved(ConstVec2Span arrays, std::size_t count) {
    std::vector<float> numbers;
    if (!arrays) return numbers;
    numbers.resize(2 * count);
    for (std::size_t i = 0; i < count; ++i) {
        numbers[2 * i] = arrays.x[i];
        numbers[2 * i + 1] = arrays.y[i];
    }
    return numbers;
}

std::string number_array(const char* type, const char* name, std::span<const float> numbers) {
    return array_text(type, name, numbers);
}

std::string number_array(const char* type, const char* name, std::span<const std::uint32_t> numbers) {
    return array_text(type, name, numbers);
}

std::string number_array(const char* type, const char* name, std::span<const std::int32_t> numbers) {
    return array_text(type, name, numbers);
}

}  // namespace candela::target
