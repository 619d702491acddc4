#include "kernel_text.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <vector>

#include "robustness/fuzz/fuzz.h"

namespace fuzz {

namespace kl = candela::kernel_language;

namespace {

bool is_in_word(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.';
}

/// Splits text into words and signs by its own rules, because the language's lexer is under test.
std::vector<std::string> pieces_of(const std::string& text) {
    std::vector<std::string> pieces;
    for (std::size_t i = 0; i < text.size();) {
        if (text[i] == ' ' || text[i] == '\n') {
            ++i;
            continue;
        }
        std::size_t end = i + 1;
        if (is_in_word(text[i]))
            while (end < text.size() && is_in_word(text[end])) ++end;
        pieces.push_back(text.substr(i, end - i));
        i = end;
    }
    return pieces;
}

constexpr std::array<std::string_view, 24> k_foreign = {
    "asm",      "goto",     "sizeof", "decltype", "new",    "delete", "operator", "template",
    "auto",     "typedef",  "using",  "static",   "union",  "class",  "enum",     "void",
    "volatile", "unsigned", "while",  "do",       "switch", "typeof", "throw",    "reinterpret_cast"};

/// Tokens that cannot precede a product, and so would turn it into a pointer.
std::set<std::string> types_in(const std::vector<std::string>& pieces) {
    std::set<std::string> types{"float",      "int",      "bool",   "vec2",    "vec3",         "vec4",
                                "mat3",       "Table",    "const",  "Surface", "Reflected",    "Refracted",
                                "Receiver",   "Incident", "return", "else",    "ShadingPoint", "Triangle",
                                "FaceCorner", "KERNEL",   "struct"};
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i)
        if (pieces[i] == "struct") types.insert(pieces[i + 1]);
    return types;
}

void check_signs(const std::string& text) {
    require(std::ranges::all_of(text, [](char c) { return (c >= ' ' && c <= '~') || c == '\n'; }),
            "compiled text is ASCII");
    require(text.find_first_of("#\"'\\@$`~^") == std::string::npos,
            "no directive, string, splice or bitwise operator");
    for (const char* const foreign :
         {"::", "->", "//", "/*", "%:", "<:", ":>", "<%", "%>", "??", "[[", "<<", ">>", "..."})
        require(text.find(foreign) == std::string::npos, "nothing that is not in the language");
    const std::vector<std::string> pieces = pieces_of(text);
    const std::set<std::string> types = types_in(pieces);
    int depth = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const std::string& piece = pieces[i];
        const std::string before = i > 0 ? pieces[i - 1] : "",
                          after = i + 1 < pieces.size() ? pieces[i + 1] : "";
        const bool follows_operand =
            !before.empty() && (is_in_word(before[0]) || before == ")" || before == "]");
        if (piece == "*")
            require(follows_operand && !types.contains(before) && after != ")" && after != "," &&
                        after != "*" && after != ";",
                    "a product has two operands");
        if (piece == "&")
            require((after == "&" && follows_operand && !types.contains(before)) || before == "&",
                    "'&' only as 'and'");
        if (piece == "[")
            require(follows_operand && !types.contains(before), "no attribute, lambda or array");
        if (piece == "(" && types.contains(after))
            require(i + 2 < pieces.size() && (pieces[i + 2] == "(" || is_in_word(pieces[i + 2][0])),
                    "no cast");
        require(std::ranges::find(k_foreign, piece) == k_foreign.end(),
                "no word that is not in the language");
        require(piece.find("__") == std::string::npos && !piece.starts_with("_"), "no reserved name");
        depth += piece == "{" ? 1 : piece == "}" ? -1 : 0;
        require(depth >= 0, "no brace closes too much");
    }
    require(depth == 0, "all braces are closed");
}

/// Without the lines that are only for C++.
std::string without_directives(const std::string& text) {
    std::string result;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string line = text.substr(begin, end - begin);
        const bool is_ours = line.starts_with("#ifdef ") || line.starts_with("#error '") ||
                             line == "#endif" || line.starts_with("#line ");
        if (!is_ours) result += line + '\n';
        begin = end + 1;
    }
    return result;
}

}  // namespace

void check_accepted(const kl::Kernel& kernel) {
    const std::string once = kl::emitted(kernel, kl::Emission::kernel);
    check_signs(once);
    check_signs(without_directives(kl::emitted(kernel, kl::Emission::guarded_cpp)));
    try {
        require(kl::emitted(kl::read_kernel({"again", once}), kl::Emission::kernel) == once,
                "written text reads back as itself");
    } catch (const kl::Problem& problem) {
        // Explicit conversions take more words and deeper brackets.
        const std::string_view what = problem.what();
        const bool is_limit = what.find("nested more than") != std::string_view::npos ||
                              what.find("are allowed") != std::string_view::npos ||
                              what.find("has more than") != std::string_view::npos ||
                              what.find("depend on one another") != std::string_view::npos;
        require(is_limit, "written text is in the language");
    }
}

void check_problem(const kl::Problem& problem, std::string_view text) {
    const auto lines = 1 + static_cast<std::size_t>(std::ranges::count(text, '\n'));
    require(problem.line() >= 1 && problem.line() <= lines, "a problem is on a line of the text");
    require(problem.column() >= 1 && *problem.what() != '\0', "a problem has a message");
}

}  // namespace fuzz
