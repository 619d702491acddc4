// Names that kernels must not declare, because C++ reserves them.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "tokens.h"

import candela.util;

namespace candela::kernel_language {

namespace {

/// The keywords that the language also has.
constexpr std::array<std::string_view, 12> k_own = {"if",     "else",  "for",   "return", "break", "continue",
                                                    "struct", "const", "float", "int",    "bool",  "true"};

/// The other keywords of C++, and those that GNU compilers add without a leading "_".
constexpr std::array<std::string_view, 87> k_foreign = {"alignas",
                                                        "alignof",
                                                        "and",
                                                        "and_eq",
                                                        "asm",
                                                        "auto",
                                                        "bitand",
                                                        "bitor",
                                                        "case",
                                                        "catch",
                                                        "char",
                                                        "char8_t",
                                                        "char16_t",
                                                        "char32_t",
                                                        "class",
                                                        "co_await",
                                                        "co_return",
                                                        "co_yield",
                                                        "compl",
                                                        "concept",
                                                        "const_cast",
                                                        "consteval",
                                                        "constexpr",
                                                        "constinit",
                                                        "contract_assert",
                                                        "decltype",
                                                        "default",
                                                        "delete",
                                                        "do",
                                                        "double",
                                                        "dynamic_cast",
                                                        "enum",
                                                        "explicit",
                                                        "export",
                                                        "extern",
                                                        "friend",
                                                        "goto",
                                                        "import",
                                                        "inline",
                                                        "long",
                                                        "module",
                                                        "mutable",
                                                        "namespace",
                                                        "new",
                                                        "noexcept",
                                                        "not",
                                                        "not_eq",
                                                        "nullptr",
                                                        "operator",
                                                        "or",
                                                        "or_eq",
                                                        "override",
                                                        "private",
                                                        "protected",
                                                        "public",
                                                        "reflexpr",
                                                        "register",
                                                        "reinterpret_cast",
                                                        "requires",
                                                        "restrict",
                                                        "short",
                                                        "signed",
                                                        "sizeof",
                                                        "static",
                                                        "static_assert",
                                                        "static_cast",
                                                        "switch",
                                                        "synchronized",
                                                        "template",
                                                        "this",
                                                        "thread_local",
                                                        "throw",
                                                        "try",
                                                        "typedef",
                                                        "typeid",
                                                        "typename",
                                                        "typeof",
                                                        "typeof_unqual",
                                                        "union",
                                                        "unsigned",
                                                        "using",
                                                        "virtual",
                                                        "void",
                                                        "volatile",
                                                        "wchar_t",
                                                        "while",
                                                        "xor"};

bool is_one_of(std::string_view word, const auto& words) {
    return std::ranges::find(words, word) != words.end();
}

/// Macros and names of headers and compilers without a leading "_".
constexpr std::array<std::string_view, 9> k_taken = {"defined", "errno", "i386",   "linux", "std",
                                                     "stderr",  "stdin", "stdout", "unix"};

bool is_reserved(std::string_view name) {
    return name.starts_with("_") || name.find("__") != std::string_view::npos || name == "KERNEL" ||
           name.starts_with("CANDELA") || name.starts_with("candela_") || is_one_of(name, k_taken);
}

}  // namespace

bool is_keyword(std::string_view word) {
    return is_one_of(word, k_own) || is_one_of(word, k_foreign) || word == "false" || word == "xor_eq";
}

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
    if (is_keyword(name)) {
        const bool is_own = is_one_of(name, k_own) || name == "false";
        return is_own ? fmt::format("'{}' is a word of the language; choose another name", name)
                      : refusal_of_keyword(name);
    }
    if (is_reserved(name)) return fmt::format("'{}' is a reserved name; choose another", shortened(name));
    return {};
}

}  // namespace candela::kernel_language
