// Names that kernels must not declare, because C++ or GLSL reserves them.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "tokens.h"

import candela.util;

namespace candela::kernel_language {

namespace {

// clang-format off

/// The keywords that the language also has.
constexpr auto k_own = std::to_array<std::string_view>({
    "if", "else", "for", "return", "break", "continue", "struct", "const", "float", "int", "bool", "true",
    "false"
});

/// The other keywords of C++, and those that GNU compilers add without a leading "_".
constexpr auto k_cpp = std::to_array<std::string_view>({
    "alignas", "alignof", "and", "and_eq", "asm", "auto", "bitand", "bitor", "case", "catch", "char",
    "char8_t", "char16_t", "char32_t", "class", "co_await", "co_return", "co_yield", "compl", "concept",
    "const_cast", "consteval", "constexpr", "constinit", "contract_assert", "decltype", "default",
    "delete", "do", "double", "dynamic_cast", "enum", "explicit", "export", "extern", "friend", "goto",
    "import", "inline", "long", "module", "mutable", "namespace", "new", "noexcept", "not", "not_eq",
    "nullptr", "operator", "or", "or_eq", "override", "private", "protected", "public", "reflexpr",
    "register", "reinterpret_cast", "requires", "restrict", "short", "signed", "sizeof", "static",
    "static_assert", "static_cast", "switch", "synchronized", "template", "this", "thread_local", "throw",
    "try", "typedef", "typeid", "typename", "typeof", "typeof_unqual", "union", "unsigned", "using",
    "virtual", "void", "volatile", "wchar_t", "while", "xor", "xor_eq"
});

/// Macros and names of headers and compilers without a leading "_".
constexpr auto k_taken = std::to_array<std::string_view>({
    "defined", "EOF", "errno", "HUGE_VAL", "i386", "INFINITY", "linux", "NAN", "NULL", "std", "stderr",
    "stdin", "stdout", "unix"
});

/// The other words that GLSL 3.30 to 4.60 and GLSL ES 3.00 have or reserve; is_glsl_type() knows the types.
constexpr auto k_glsl = std::to_array<std::string_view>({
    "active", "atomic_uint", "attribute", "buffer", "cast", "centroid", "coherent", "common", "discard",
    "external", "filter", "fixed", "flat", "half", "highp", "in", "inout", "input", "interface",
    "invariant", "layout", "lowp", "mediump", "noinline", "noperspective", "out", "output", "packed",
    "partition", "patch", "precise", "precision", "readonly", "resource", "row_major", "sample",
    "sampler", "samplerShadow", "shared", "smooth", "subpassInput", "subroutine", "superp", "uint",
    "uniform", "varying", "writeonly"
});

/// Functions that every shader has, but no kernel: GLSL ES allows nothing else of such a name outside
/// functions.
constexpr auto k_glsl_functions = std::to_array<std::string_view>({
    "acosh", "all", "any", "asinh", "atanh", "cosh", "dFdx", "dFdy", "equal", "faceforward",
    "floatBitsToInt", "floatBitsToUint", "fma", "frexp", "fwidth", "greaterThan", "greaterThanEqual",
    "intBitsToFloat", "isinf", "isnan", "ldexp", "lessThan", "lessThanEqual", "main", "matrixCompMult",
    "modf", "notEqual", "outerProduct", "packHalf2x16", "packSnorm2x16", "packUnorm2x16", "round",
    "roundEven", "sinh", "tanh", "texelFetch", "texelFetchOffset", "texture", "textureGrad",
    "textureGradOffset", "textureLod", "textureLodOffset", "textureOffset", "textureProj",
    "textureProjGrad", "textureProjGradOffset", "textureProjLod", "textureProjLodOffset",
    "textureProjOffset", "textureSize", "uintBitsToFloat", "unpackHalf2x16", "unpackSnorm2x16",
    "unpackUnorm2x16"
});

// clang-format on

bool is_one_of(std::string_view word, const auto& words) {
    return std::ranges::find(words, word) != words.end();
}

bool is_reserved(std::string_view name) {
    constexpr auto k_prefixes =
        std::to_array<std::string_view>({"_", "CANDELA", "candela_", "gl_", "GL_", "webgl_", "M_"});
    return std::ranges::any_of(k_prefixes, [&](std::string_view each) { return name.starts_with(each); }) ||
           name.find("__") != std::string_view::npos || name == "KERNEL" || is_one_of(name, k_taken);
}

/// Removes a prefix from the text, if it is there.
bool skip(std::string_view& text, std::string_view prefix) {
    if (!text.starts_with(prefix)) return false;
    text.remove_prefix(prefix.size());
    return true;
}

/// The types of GLSL that the language does not have: "uvec3", "mat3x4", "isampler2DArray", "image1D".
bool is_glsl_type(std::string_view name) {
    if (name == "vec2" || name == "vec3" || name == "vec4" || name == "mat3") return false;
    if (name.find_first_of("bdfhiu") == 0 && !name.starts_with("image")) name.remove_prefix(1);
    if (skip(name, "vec") || skip(name, "mat"))
        return is_one_of(name, std::to_array<std::string_view>({"2", "3", "4", "2x2", "2x3", "2x4", "3x2",
                                                                "3x3", "3x4", "4x2", "4x3", "4x4"}));
    if (!skip(name, "sampler") && !skip(name, "image") && !skip(name, "texture")) return false;
    if (!skip(name, "1D") && !skip(name, "2D") && !skip(name, "3D") && !skip(name, "Cube") &&
        !skip(name, "Buffer"))
        return false;
    return is_one_of(name, std::to_array<std::string_view>({"", "Array", "Shadow", "ArrayShadow", "Rect",
                                                            "RectShadow", "MS", "MSArray"}));
}

}  // namespace

bool is_keyword(std::string_view word) { return is_one_of(word, k_own) || is_one_of(word, k_cpp); }

std::string refusal_of_keyword(std::string_view word) {
    std::string text = fmt::format("the kernel language has no '{}'", word);
    if (word == "while" || word == "do")
        text += "; a loop needs a constant bound: for (int i = 0; i < 8; ++i)";
    if (word == "double") text += "; numbers with a fraction are float";
    if (word == "auto") text += "; name the type: float, int, bool, vec3 …";
    if (word == "void") text += "; every function returns a value";
    if (word == "switch" || word == "goto") text += "; choose with if, or with condition ? a : b";
    if (word == "and" || word == "or" || word == "not")
        text += fmt::format("; write {}", word == "and" ? "&&" : word == "or" ? "||" : "!");
    if (word == "static_cast" || word == "const_cast" || word == "reinterpret_cast")
        text += "; convert with float(x) or int(x)";
    return text;
}

std::string problem_with_name(std::string_view name) {
    if (is_one_of(name, k_own))
        return fmt::format("'{}' is a word of the language; choose another name", name);
    if (is_keyword(name)) return refusal_of_keyword(name);
    if (is_reserved(name)) return fmt::format("'{}' is a reserved name; choose another", shortened(name));
    return {};
}

std::string problem_with_new_name(std::string_view name) {
    if (std::string problem = problem_with_name(name); !problem.empty()) return problem;
    if (is_one_of(name, k_glsl) || is_glsl_type(name))
        return fmt::format("'{}' is a word of GLSL, the language of shaders; choose another name", name);
    return {};
}

bool is_glsl_function(std::string_view name) { return is_one_of(name, k_glsl_functions); }

}  // namespace candela::kernel_language
