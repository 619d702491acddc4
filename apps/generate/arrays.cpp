#include "arrays.h"

#include "literals.h"

namespace generate {

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

std::vector<float> interleaved(const candela::Vec3Arrays& arrays) {
    std::vector<float> numbers;
    numbers.reserve(3 * arrays.size());
    for (std::size_t i = 0; i < arrays.size(); ++i)
        numbers.insert(numbers.end(), {arrays.x[i], arrays.y[i], arrays.z[i]});
    return numbers;
}

std::vector<float> interleaved_uv(const candela::Mesh& mesh) {
    std::vector<float> numbers;
    for (std::size_t i = 0; i < mesh.u.size(); ++i) numbers.insert(numbers.end(), {mesh.u[i], mesh.v[i]});
    return numbers;
}

std::string number_array(const char* type, const char* name, std::span<const float> numbers) {
    return array_text(type, name, numbers);
}

std::string number_array(const char* type, const char* name, std::span<const std::uint32_t> numbers) {
    return array_text(type, name, numbers);
}

}  // namespace generate
