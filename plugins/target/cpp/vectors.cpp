#include "vectors.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>
#include <string_view>

#include "candela/embed.h"
#include "candela/target/kernels.h"

CANDELA_EMBED(candela_cpp_vectors, CANDELA_SOURCE_DIR "/templates/vectors.h");

namespace candela::cpp_target {

namespace {

constexpr std::string_view k_components = "xyzw";
constexpr std::string_view k_place_of_swizzles = "SWIZZLES";

bool is_spoken_of(const std::string& word, const std::string& text) {
    return std::regex_search(text, std::regex("\\b" + word + "\\b"));
}

std::string vector_of(std::size_t size) { return fmt::format("vec{}", size); }

/// "zyx" where a text reads v.zyx.
std::set<std::string> swizzles_in(const std::string& code) {
    static const std::regex k_swizzle(R"(\.\s*([xyzw]{2,4})\b)");
    std::set<std::string> found;
    for (auto m = std::sregex_iterator(code.begin(), code.end(), k_swizzle); m != std::sregex_iterator(); ++m)
        found.insert((*m)[1]);
    return found;
}

/// The declarations of those swizzles that a vector of `size` components has.
std::string members_of(std::size_t size, const std::set<std::string>& swizzles) {
    std::string text;
    for (const std::string& name : swizzles) {
        if (name.find_first_not_of(k_components.substr(0, size)) != std::string::npos) continue;
        std::string components;
        for (const char c : name) components += fmt::format(", &{}::{}", vector_of(size), c);
        text += fmt::format("    [[no_unique_address]] Swizzle<{}, {}{}> {};\n", vector_of(size),
                            vector_of(name.size()), components, name);
    }
    return text;
}

constexpr std::string_view k_swizzle =
    "// v.zyx: some of a vector's components, at the vector's own address.\n"
    "template <class Whole, class Part, float Whole::*... components>\n"
    "struct Swizzle {\n"
    "    operator Part() const { return Part(reinterpret_cast<const Whole*>(this)->*components...); }\n"
    "};\n\n";

/// The program itself interpolates texture coordinates, whether or not a kernel has vectors of two.
bool is_of_program(const std::string& line) {
    return line.starts_with("inline vec2 operator+(vec2 a, vec2 b)") ||
           line.starts_with("inline vec2 operator*(float s, vec2 a)");
}

/// Assignment operators are needed if a kernel uses one.
bool assigns_in_vain(const std::string& line, const std::string& code) {
    static const std::regex k_assigning(R"(^inline .*operator([-+*/]=))");
    std::smatch found;
    return std::regex_search(line, found, k_assigning) && code.find(found[1]) == std::string::npos;
}

}  // namespace

std::string vectors_for(const std::string& kernels) {
    const std::string code = target::without_comments(kernels);
    const std::set<std::string> swizzles = swizzles_in(code);
    std::set<std::string> unused;
    for (const char* const type : {"vec2", "vec4", "mat3"}) {
        if (!is_spoken_of(type, code)) unused.insert(type);
    }
    std::set<std::string> parts;
    for (const std::string& name : swizzles) parts.insert(vector_of(name.size()));
    std::string text;
    for (const std::string& part : parts) {
        unused.erase(part);
        text += fmt::format("struct {};\n", part);
    }
    if (!swizzles.empty()) text += k_swizzle;

    std::istringstream lines{std::string(candela_cpp_vectors)};
    lines.exceptions(
        std::ios::badbit);  // otherwise std::getline() swallows std::bad_alloc, and the rest is lost
    std::string current;    // the struct that a line is in
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("struct ")) current = line.substr(7, 4);
        const bool is_in_vain = std::ranges::any_of(
            unused, [&](const std::string& type) { return current != type && is_spoken_of(type, line); });
        if (line.starts_with("};")) current.clear();
        if ((is_in_vain && !is_of_program(line)) || assigns_in_vain(line, code)) continue;
        if (line.find(k_place_of_swizzles) == std::string::npos) {
            text += line + '\n';
        } else if (current.starts_with("vec")) {
            text += members_of(static_cast<std::size_t>(current[3] - '0'), swizzles);
        }
    }
    return text;
}

}  // namespace candela::cpp_target
