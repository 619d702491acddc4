#include "inspect/kernel_trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>

#include "candela/kernel_language/lexer.h"

namespace kl = candela::kernel_language;

namespace {

using Code = std::span<const kl::Lexeme>;

bool is_name(const kl::Lexeme& lexeme) { return lexeme.kind == kl::Lexeme::Kind::name; }

/// The position after the preprocessor line that begins at `offset`.
std::size_t end_of_directive(std::string_view text, std::size_t offset) {
    std::size_t end = text.find('\n', offset);
    while (end != std::string_view::npos && text[end - 1] == '\\') end = text.find('\n', end + 1);
    return std::min(end, text.size());
}

/// The lexemes of a kernel that its compiler sees: neither comments nor preprocessor lines.
std::vector<kl::Lexeme> compiled_code(std::string_view text) {
    std::vector<kl::Lexeme> code;
    std::size_t directive_end = 0;
    bool at_line_begin = true;
    for (const kl::Lexeme& lexeme : kl::lexemes_of(text)) {
        if (lexeme.text.find('\n') != std::string_view::npos) at_line_begin = true;
        if (lexeme.is_skipped() || lexeme.offset < directive_end) continue;
        if (at_line_begin && lexeme.text == "#") {
            directive_end = end_of_directive(text, lexeme.offset);
            continue;
        }
        at_line_begin = false;
        code.push_back(lexeme);
    }
    return code;
}

std::string on_one_line(std::string_view text) {
    std::string result;
    for (const kl::Lexeme& lexeme : kl::lexemes_of(text)) {
        if (!lexeme.is_skipped()) {
            result += lexeme.text;
        } else if (!result.ends_with(' ')) {
            result += ' ';
        }
    }
    return result;
}

/// The index of the first lexeme with this text; the code's size if there is none.
std::size_t index_of(std::string_view text, Code code) {
    return static_cast<std::size_t>(std::ranges::find(code, text, &kl::Lexeme::text) - code.begin());
}

/// The parts of the code between commas outside brackets.
std::vector<Code> parts_of(Code code) {
    std::vector<Code> parts;
    int depth = 0;
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= code.size(); ++i) {
        const std::string_view text = i < code.size() ? code[i].text : ",";
        if (text == "(" || text == "[" || text == "{") ++depth;
        if (text == ")" || text == "]" || text == "}") --depth;
        if (text != "," || (depth > 0 && i < code.size())) continue;
        if (i > begin) parts.push_back(code.subspan(begin, i - begin));
        begin = i + 1;
    }
    return parts;
}

/// The index of a statement's assignment operator, if it has one.
std::optional<std::size_t> assignment_in(Code statement) {
    constexpr std::array<std::string_view, 6> k_operators = {"=", "+=", "-=", "*=", "/=", "%="};
    constexpr std::array<std::string_view, 4> k_comparisons = {"==", "!=", "<=", ">="};
    int depth = 0;
    for (std::size_t i = 0; i < statement.size(); ++i) {
        const std::string_view text = statement[i].text;
        if (text == "(" || text == "[") ++depth;
        if (text == ")" || text == "]") --depth;
        if (depth != 0) continue;
        if (std::ranges::find(k_comparisons, text) != k_comparisons.end()) return std::nullopt;
        if (std::ranges::find(k_operators, text) == k_operators.end()) continue;
        // The kernel language has no operators of bits, but the kernels of plugins may.
        const bool is_of_bits = i > 0 && statement[i - 1].end() == statement[i].offset &&
                                std::string_view("&|^").find(statement[i - 1].text) != std::string_view::npos;
        return is_of_bits ? i - 1 : i;
    }
    return std::nullopt;
}

/// "vec3 r = …", "const float x = …", "float a, b".
bool is_declaration(Code statement) {
    return statement.size() > 1 && is_name(statement[0]) && is_name(statement[1]);
}

class Tracer {
  public:
    Tracer(std::string_view text, std::string file, std::vector<KernelStep>& steps)
        : text_(text), code_(compiled_code(text)), file_(std::move(file)), steps_(steps) {}

    std::string traced() {
        while (at_ < code_.size()) declaration();
        copy_to(text_.size());
        return std::move(out_);
    }

  private:
    Code code(std::size_t begin, std::size_t end) const { return Code(code_).subspan(begin, end - begin); }
    std::string_view text(std::size_t at) const { return kl::text_at(code_, at); }

    /// Where a lexeme begins; the text's end if there is none.
    std::size_t offset(std::size_t at) const { return at < code_.size() ? code_[at].offset : text_.size(); }

    /// The text of some lexemes as written, with the comments between them.
    std::string_view written(std::size_t begin, std::size_t end) const {
        if (begin >= end) return {};
        return text_.substr(code_[begin].offset, code_[end - 1].end() - code_[begin].offset);
    }

    /// Copies what is left of the text before this position.
    void copy_to(std::size_t end) {
        if (end > copied_) out_ += text_.substr(copied_, end - copied_);
        copied_ = std::max(copied_, end);
    }

    /// Advances past lexeme `at`, and copies the text up to there.
    void take_through(std::size_t at) {
        at_ = std::min(at + 1, code_.size());
        copy_to(at < code_.size() ? code_[at].end() : text_.size());
    }

    /// The index of the first lexeme from `begin` on that has this text; the code's size if there is none.
    std::size_t find(std::string_view wanted, std::size_t begin) const {
        return begin + index_of(wanted, code(begin, code_.size()));
    }

    /// The index of the bracket that closes the one at `open`; the code's size if there is none.
    std::size_t closing(std::size_t open) const {
        int depth = 0;
        for (std::size_t i = open; i < code_.size(); ++i) {
            if (text(i) == "(" || text(i) == "{") ++depth;
            if ((text(i) == ")" || text(i) == "}") && --depth == 0) return i;
        }
        return code_.size();
    }

    std::size_t step(KernelStep::Kind kind, std::size_t where, std::string_view name, std::string_view text) {
        const auto line =
            static_cast<std::size_t>(std::ranges::count(text_.substr(0, offset(where)), '\n')) + 1;
        steps_.push_back({kind, file_, line, std::string(name), on_one_line(text)});
        return steps_.size() - 1;
    }

    void note(std::size_t number, std::string_view what) {
        out_ += fmt::format(" candela_trace::note({}, \"\", {});", number, what);
    }

    /// Something at file scope: a struct, a function, a constant.
    void declaration() {
        std::size_t end = at_;
        while (end < code_.size() && text(end) != ";" && text(end) != "{") ++end;
        const Code head = code(at_, end);
        if (text(end) == "{" && text(at_) == "struct") return structure(end);
        const std::size_t parenthesis = index_of("(", head);
        if (text(end) == "{" && parenthesis > 0 && parenthesis < head.size() &&
            index_of("=", head) == head.size())
            return function(at_ + parenthesis, end);
        take_through(find(";", text(end) == "{" ? closing(end) : end));
    }

    /// Adds a function that notes a struct's members one by one.
    void structure(std::size_t open) {
        const std::string_view name = text(open - 1);
        const std::size_t close = closing(open);
        std::string members;
        for (std::size_t begin = open + 1, end = 0; (end = find(";", begin)) < close; begin = end + 1) {
            const Code member = code(begin, end);
            if (index_of("[", member) < member.size()) continue;
            for (const Code part : parts_of(member)) {
                members += fmt::format(" candela_trace::note(number, (path + \".{0}\").c_str(), value.{0});",
                                       part.back().text);
            }
        }
        take_through(find(";", close));
        out_ += fmt::format(
            " [[maybe_unused]] static inline void note_members(int number, const std::string& path, const "
            "{}& value) {{{} }}",
            name, members);
    }

    void function(std::size_t parenthesis, std::size_t open) {
        const std::string_view name = text(parenthesis - 1);
        const std::size_t begin = at_, close = closing(parenthesis);
        take_through(open);
        out_ += fmt::format(" const candela_trace::Function candela_function({});",
                            step(KernelStep::Kind::function, begin, name, name));
        for (const Code part : parts_of(code(parenthesis + 1, std::min(close, open)))) {
            const std::string_view called = part.back().text;
            const auto first = static_cast<std::size_t>(part.data() - code_.data());
            note(step(KernelStep::Kind::argument, begin, called, written(first, first + part.size())),
                 called);
        }
        const std::size_t end = closing(open);
        while (at_ < end) statement(end);
        if (end < code_.size()) take_through(end);
    }

    /// Advances to the next statement of a function that ends at `end`.
    void statement(std::size_t end) {
        const std::string_view word = text(at_);
        if (word == "{" || word == "}" || word == ";" || word == "else" || word == "do")
            return take_through(at_);
        if (word == "if" || word == "for" || word == "while")
            return take_through(std::min(closing(find("(", at_)), end - 1));
        const std::size_t begin = at_, semicolon = std::min(find(";", at_), end);
        if (semicolon == end) return take_through(end - 1);
        const Code statement = code(begin, semicolon);
        if (word == "return" && statement.size() > 1) {
            const std::size_t number =
                step(KernelStep::Kind::result, begin, "return", written(begin, semicolon));
            copy_to(offset(begin));
            out_ += "return candela_trace::result(" + std::to_string(number) + ", (";
            copied_ = code_[begin].end();
            copy_to(offset(semicolon));
            out_ += "))";
            return take_through(semicolon);
        }
        if (is_declaration(statement)) {
            take_through(semicolon);
            for (const Code part : parts_of(statement)) {
                const std::size_t equals = index_of("=", part);
                if (equals == 0 || equals == part.size()) continue;
                const std::string_view name = part[equals - 1].text;
                note(step(KernelStep::Kind::value, begin, name, written(begin, semicolon)), name);
            }
            return;
        }
        const auto assignment = assignment_in(statement);
        if (!assignment) return take_through(semicolon);
        // Braces keep it a single statement after an `if`.
        const std::string name = on_one_line(written(begin, begin + *assignment));
        copy_to(offset(begin));
        out_ += "{ ";
        take_through(semicolon);
        note(step(KernelStep::Kind::value, begin, name, written(begin, semicolon)), name);
        out_ += " }";
    }

    std::string_view text_;
    std::vector<kl::Lexeme> code_;
    std::string file_;
    std::vector<KernelStep>& steps_;
    std::size_t at_ = 0;      // of code_: what comes next
    std::size_t copied_ = 0;  // of text_
    std::string out_;
};

}  // namespace

std::string TracedKernels::traced(std::string_view text, const std::string& file) {
    return Tracer(text, file, steps).traced();
}

// Distinguishes values by their members, because the kernel language's types are declared later. A note is
// "note NUMBER DEPTH PATH VALUES…"; the path is "." for a value outside a struct.
std::string_view kernel_trace_prelude() noexcept {
    return R"(#include <cstdio>
#include <string>
namespace candela_trace {
inline int depth = 0;
struct Function {
    explicit Function(int number) { std::printf("enter %d %d .\n", number, depth++); }
    ~Function() { --depth; }
};
template <class T>
void note(int number, const char* path, const T& value) {
    if constexpr (requires { note_members(number, std::string(path), value); }) {
        note_members(number, std::string(path), value);
    } else {
        std::printf("note %d %d %s", number, depth, *path == '\0' ? "." : path);
        if constexpr (requires { value.w; }) {
            std::printf(" %.9g %.9g %.9g %.9g", double(value.x), double(value.y), double(value.z), double(value.w));
        } else if constexpr (requires { value.z; }) {
            std::printf(" %.9g %.9g %.9g", double(value.x), double(value.y), double(value.z));
        } else if constexpr (requires { value.x; }) {
            std::printf(" %.9g %.9g", double(value.x), double(value.y));
        } else if constexpr (requires { value[0][0]; }) {
            for (int c = 0; c < 3; ++c)
                for (int r = 0; r < 3; ++r) std::printf(" %.9g", double(value[c][r]));
        } else if constexpr (requires { double(value); }) {
            std::printf(" %.9g", double(value));
        }
        std::printf("\n");
    }
}
template <class T>
T result(int number, T value) {
    note(number, "", value);
    return value;
}
}
)";
}
