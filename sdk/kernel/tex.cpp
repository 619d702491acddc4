// Equations in TeX as plain text.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "candela/kernel_language/model.h"

import candela.util;

namespace candela::kernel_language {

namespace {

// Within the converter: a wide blank, and the bars around a length. They become blanks and bars at the end.
constexpr char k_wide = '\x01', k_open_bar = '\x02', k_closing_bar = '\x03';

constexpr std::array<std::pair<std::string_view, std::string_view>, 36> k_signs{
    {{"cdot", "."},     {"leq", " <= "},   {"geq", " >= "},  {"neq", " != "},    {"pm", " +- "},
     {"ll", " << "},    {"gg", " >> "},    {"bar", ""},      {"tilde", ""},      {"cdots", "..."},
     {"to", " -> "},    {"mid", " | "},    {"times", " x "}, {"le", " <= "},     {"ge", " >= "},
     {"lt", " < "},     {"gt", " > "},     {"ne", " != "},   {"lvert", "\x02"},  {"rvert", "\x03"},
     {"lVert", "\x02"}, {"rVert", "\x03"}, {"left", ""},     {"right", ""},      {"quad", "\x01"},
     {"qquad", "\x01"}, {"dots", "..."},   {"ldots", "..."}, {"approx", " ~ "},  {"infty", "inf"},
     {"hat", ""},       {"vec", ""},       {"circ", " deg"}, {"lceil", "ceil("}, {"rceil", ")"},
     {"Delta", "d"}}};

/// Commands that are printed as their names.
constexpr auto k_names = std::to_array<std::string_view>({
    // clang-format off
    "alpha", "beta", "gamma", "delta", "epsilon", "varepsilon", "zeta", "eta", "theta", "vartheta", "iota",
    "kappa", "lambda", "mu", "nu", "xi", "pi", "rho", "varrho", "sigma", "tau", "upsilon", "phi", "varphi",
    "chi", "psi", "omega", "Gamma", "Theta", "Lambda", "Xi", "Pi", "Sigma", "Upsilon", "Phi", "Psi", "Omega",
    "sin", "cos", "tan", "cot", "arcsin", "arccos", "arctan", "sinh", "cosh", "tanh", "exp", "ln", "log", "lg",
    "min", "max", "inf", "sup", "lim", "arg", "det", "sum", "prod", "int", "iint", "partial", "nabla"
    // clang-format on
});

/// Commands whose argument is a text.
constexpr auto k_fonts = std::to_array<std::string_view>(
    {"text", "mathrm", "mathit", "mathbf", "mathcal", "operatorname", "boldsymbol"});

/// Commands with arguments that the converter knows.
constexpr auto k_structures = std::to_array<std::string_view>({"frac", "sqrt"});

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Whether the text needs brackets where something is divided by it or multiplied with it.
bool is_compound(std::string_view text) {
    if (!text.empty() && text.front() == k_open_bar && text.find(k_closing_bar) == text.size() - 1)
        return false;
    int depth = 0;
    for (const char c : text) {
        if (c == '(' || c == '[') ++depth;
        if (c == ')' || c == ']') --depth;
        if (depth == 0 && (c == ' ' || c == '/')) return true;
    }
    return false;
}

bool is_sum(std::string_view text) {
    int depth = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '(') ++depth;
        if (text[i] == ')') --depth;
        for (const std::string_view sign : {" + ", " - ", " x "})
            if (depth == 0 && i > 0 && text.substr(i).starts_with(sign)) return true;
    }
    return false;
}

class Converter {
  public:
    explicit Converter(std::string_view tex) : tex_(tex) {}

    std::string all() {
        std::string result;
        for (const char c : tidy(sequence('\0'))) {
            if (c == k_wide) {
                result += "  ";
            } else {
                result += c == k_open_bar || c == k_closing_bar ? '|' : c;
            }
        }
        return result;
    }

  private:
    static bool is_blank(char c) { return c == ' ' || c == k_wide; }

    /// Without blanks at the ends, inside brackets and bars, before a comma, around a product's point, or in
    /// a row.
    static std::string tidy(std::string_view text) {
        std::string result;
        for (std::size_t i = 0; i < text.size(); ++i) {
            const char c = text[i];
            const auto drop_blanks = [&] {
                while (!result.empty() && result.back() == ' ') result.pop_back();
            };
            const bool is_point =
                c == '.' && i > 0 && text[i - 1] == ' ' && i + 1 < text.size() && text[i + 1] == ' ';
            if (is_point || c == ')' || c == ',' || c == k_closing_bar || c == k_wide) drop_blanks();
            const bool is_useless = result.empty() || is_blank(result.back()) || result.back() == '(' ||
                                    result.back() == k_open_bar;
            if (c == ' ' && is_useless) continue;
            result += c;
            while (is_point && i + 1 < text.size() && text[i + 1] == ' ') ++i;
        }
        while (!result.empty() && is_blank(result.back())) result.pop_back();
        return result;
    }

    char peek() const { return at_ < tex_.size() ? tex_[at_] : '\0'; }

    std::string sequence(char end) {
        const std::size_t begin = at_ - 1;
        std::string text;
        while (at_ < tex_.size() && peek() != end) text += part();
        if (at_ < tex_.size())
            ++at_;
        else if (end != '\0')
            throw EquationProblem(begin, "this '{' is not closed");
        return text;
    }

    std::string part() {
        if (at_ == tex_.size()) throw EquationProblem(at_, "expected an argument");
        const char c = tex_[at_++];
        if (c == '\\') return command();
        if (c == '{') return sequence('}');
        if (c == '}') throw EquationProblem(at_ - 1, "this '}' has no opening '{'");
        if (c == '&' || c == '~') return " ";
        if (c == '^' || c == '_') return c + script(argument());
        return std::string(1, c);
    }

    static std::string script(const std::string& text) {
        return is_compound(text) || text.find_first_of("+-") != std::string::npos ? "(" + text + ")" : text;
    }

    std::string argument() {
        while (peek() == ' ') ++at_;
        return tidy(part());
    }

    std::string command() {
        if (!is_letter(peek())) {
            const char c = at_ < tex_.size() ? tex_[at_++] : ' ';
            return std::string_view("{}%_#&").find(c) != std::string_view::npos
                       ? std::string(1, c)
                       : " ";  // \, \; and so on are blanks
        }
        const std::size_t begin = at_;
        while (is_letter(peek())) ++at_;
        const std::string_view name = tex_.substr(begin, at_ - begin);
        if (name == "frac") {
            const std::string above = argument(), below = argument();
            return fmt::format("{} / {}", is_sum(above) ? "(" + above + ")" : above,
                               is_compound(below) ? "(" + below + ")" : below);
        }
        if (name == "sqrt") return fmt::format("sqrt({})", argument());
        if (std::ranges::find(k_fonts, name) != k_fonts.end()) {
            while (peek() == ' ') ++at_;
            return peek() == '{' ? (++at_, sequence('}')) : part();
        }
        for (const auto& [each, sign] : k_signs)
            if (each == name) return std::string(sign);
        if (std::ranges::find(k_names, name) != k_names.end()) return std::string(name);
        refuse(begin - 1, name);
    }

    [[noreturn]] static void refuse(std::size_t at, std::string_view command) {
        std::vector<std::string> known;
        for (const auto& [each, sign] : k_signs) known.emplace_back(each);
        for (const std::string_view each : k_names) known.emplace_back(each);
        for (const std::string_view each : k_fonts) known.emplace_back(each);
        for (const std::string_view each : k_structures) known.emplace_back(each);
        for (std::string& each : known) each.insert(0, "\\");
        const std::string written = fmt::format("\\{}", command);
        const std::string meant = suggestion(written, known);
        throw EquationProblem(at, fmt::format("unknown command '{}' in an equation{}{}", shortened(written),
                                              meant.empty() ? "" : "; ", meant));
    }

    std::string_view tex_;
    std::size_t at_ = 0;
};

}  // namespace

std::string plain_text(std::string_view tex) { return Converter(tex).all(); }

}  // namespace candela::kernel_language
