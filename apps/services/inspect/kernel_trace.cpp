#include "inspect/kernel_trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>

namespace {

bool begins_word(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool continues_word(char c) { return begins_word(c) || std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

/// The text with blanks for comments and preprocessor lines, so that positions and line numbers stay the
/// same.
std::string without_comments(std::string_view text) {
    std::string result(text);
    bool at_line_begin = true;
    const auto blank = [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) {
            if (result[i] != '\n') result[i] = ' ';
        }
    };
    for (std::size_t i = 0; i < text.size();) {
        const std::string_view rest = text.substr(i);
        std::size_t end = i;
        if (rest.starts_with("//")) {
            end = std::min(text.find('\n', i), text.size());
        } else if (rest.starts_with("/*")) {
            const std::size_t close = text.find("*/", i + 2);
            end = close == std::string_view::npos ? text.size() : close + 2;
        } else if (at_line_begin && rest.starts_with('#')) {
            do {
                end = std::min(text.find('\n', end + (end > i ? 1 : 0)), text.size());
            } while (end < text.size() && text[end - 1] == '\\');
        }
        if (end > i) {
            blank(i, end);
            i = end;
            continue;
        }
        at_line_begin = text[i] == '\n' || (at_line_begin && is_space(text[i]));
        ++i;
    }
    return result;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
    return text;
}

std::string on_one_line(std::string_view text) {
    std::string result;
    for (const char c : trimmed(text)) {
        if (!is_space(c)) {
            result += c;
        } else if (!result.ends_with(' ')) {
            result += ' ';
        }
    }
    return result;
}

std::string_view first_word(std::string_view text) {
    if (text.empty() || !begins_word(text.front())) return {};
    return text.substr(
        0, static_cast<std::size_t>(std::ranges::find_if_not(text, continues_word) - text.begin()));
}

std::string_view last_word(std::string_view text) {
    text = trimmed(text);
    std::size_t begin = text.size();
    while (begin > 0 && continues_word(text[begin - 1])) --begin;
    return text.substr(begin);
}

/// The parts of `text` between commas outside parentheses.
std::vector<std::string_view> parts_of(std::string_view text) {
    std::vector<std::string_view> parts;
    int depth = 0;
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= text.size(); ++i) {
        const char c = i < text.size() ? text[i] : ',';
        if (c == '(' || c == '[' || c == '{') ++depth;
        if (c == ')' || c == ']' || c == '}') --depth;
        if (c != ',' || (depth > 0 && i < text.size())) continue;
        if (!trimmed(text.substr(begin, i - begin)).empty())
            parts.push_back(trimmed(text.substr(begin, i - begin)));
        begin = i + 1;
    }
    return parts;
}

/// The position of a statement's assignment operator, if it has one.
std::optional<std::size_t> assignment_in(std::string_view statement) {
    int depth = 0;
    for (std::size_t i = 0; i < statement.size(); ++i) {
        const char c = statement[i];
        if (c == '(' || c == '[') ++depth;
        if (c == ')' || c == ']') --depth;
        if (c != '=' || depth != 0) continue;
        if (i + 1 < statement.size() && statement[i + 1] == '=') return std::nullopt;
        const char before = i > 0 ? statement[i - 1] : ' ';
        if (before == '<' || before == '>' || before == '!') return std::nullopt;
        return std::string_view("+-*/%&|^").find(before) != std::string_view::npos ? i - 1 : i;
    }
    return std::nullopt;
}

class Tracer {
  public:
    Tracer(std::string_view text, std::string file, std::vector<KernelStep>& steps)
        : raw_(text), text_(without_comments(text)), file_(std::move(file)), steps_(steps) {}

    std::string traced() {
        while (at_ < text_.size()) declaration();
        return std::move(out_);
    }

  private:
    std::string_view rest() const { return std::string_view(text_).substr(at_); }

    void take(std::size_t count) {
        count = std::min(count, text_.size() - at_);
        out_.append(raw_, at_, count);
        at_ += count;
    }

    void take_space() {
        while (at_ < text_.size() && is_space(text_[at_])) take(1);
    }

    /// The position of the bracket that closes the one at `open`; the text's end if there is none.
    std::size_t closing(std::size_t open) const {
        int depth = 0;
        for (std::size_t i = open; i < text_.size(); ++i) {
            if (text_[i] == '(' || text_[i] == '{') ++depth;
            if ((text_[i] == ')' || text_[i] == '}') && --depth == 0) return i;
        }
        return text_.size();
    }

    std::size_t step(KernelStep::Kind kind, std::size_t where, std::string_view name, std::string_view text) {
        const auto line = static_cast<std::size_t>(std::count(
                              text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(where), '\n')) +
                          1;
        steps_.push_back({kind, file_, line, std::string(name), on_one_line(text)});
        return steps_.size() - 1;
    }

    void note(std::size_t number, std::string_view what) {
        out_ += fmt::format(" candela_trace::note({}, \"\", {});", number, what);
    }

    /// Something at file scope: a struct, a function, a constant.
    void declaration() {
        take_space();
        const std::size_t end = text_.find_first_of(";{", at_);
        if (end == std::string::npos) return take(text_.size());
        const std::string_view head = std::string_view(text_).substr(at_, end - at_);
        if (text_[end] == '{' && first_word(head) == "struct") return structure(head, end);
        const std::size_t parenthesis = head.find('(');
        if (text_[end] == '{' && parenthesis != std::string_view::npos &&
            head.find('=') == std::string_view::npos)
            return function(at_ + parenthesis, end);
        if (text_[end] == '{') take(closing(end) - at_);
        const std::size_t semicolon = text_.find(';', at_);
        take(semicolon == std::string::npos ? text_.size() : semicolon + 1 - at_);
    }

    /// Adds a function that notes a struct's members one by one.
    void structure(std::string_view head, std::size_t open) {
        const std::string name(last_word(head));
        const std::size_t close = closing(open);
        std::string members;
        const std::string body = text_.substr(open + 1, close > open ? close - open - 1 : 0);
        std::size_t begin = 0;
        for (std::size_t end; (end = body.find(';', begin)) != std::string::npos; begin = end + 1) {
            const std::string_view member = std::string_view(body).substr(begin, end - begin);
            if (member.find('[') != std::string_view::npos) continue;
            for (const std::string_view part : parts_of(member)) {
                const std::string_view called = last_word(part);
                members += fmt::format(" candela_trace::note(number, (path + \".{0}\").c_str(), value.{0});",
                                       called);
            }
        }
        const std::size_t semicolon = text_.find(';', close);
        take(semicolon == std::string::npos ? text_.size() : semicolon + 1 - at_);
        out_ += fmt::format(
            " [[maybe_unused]] static inline void note_members(int number, const std::string& path, const "
            "{}& value) {{{} }}",
            name, members);
    }

    void function(std::size_t parenthesis, std::size_t open) {
        const std::string name(last_word(std::string_view(text_).substr(at_, parenthesis - at_)));
        const std::size_t close = closing(parenthesis), begin = at_;
        const std::string arguments = text_.substr(parenthesis + 1, close - parenthesis - 1);
        take(open + 1 - at_);
        out_ += fmt::format(" const candela_trace::Function candela_function({});",
                            step(KernelStep::Kind::function, begin, name, name));
        for (const std::string_view argument : parts_of(arguments)) {
            const std::string_view called = last_word(argument);
            note(step(KernelStep::Kind::argument, begin, called, argument), called);
        }
        const std::size_t end = closing(open);
        while (at_ < end) statement(end);
    }

    /// Advances to the next statement of a function that ends at `end`.
    void statement(std::size_t end) {
        take_space();
        if (at_ >= end) return;
        if (text_[at_] == '{' || text_[at_] == '}' || text_[at_] == ';') return take(1);
        const std::string_view word = first_word(rest());
        if (word == "else" || word == "do") return take(word.size());
        if (word == "if" || word == "for" || word == "while") {
            const std::size_t parenthesis = text_.find('(', at_);
            return take((parenthesis == std::string::npos ? end : closing(parenthesis) + 1) - at_);
        }
        const std::size_t semicolon = std::min(text_.find(';', at_), end);
        const std::string written = text_.substr(at_, semicolon - at_);
        const std::size_t begin = at_;
        if (word == "return" && !trimmed(std::string_view(written).substr(word.size())).empty()) {
            const std::size_t number = step(KernelStep::Kind::result, begin, "return", written);
            out_ +=
                fmt::format("return candela_trace::result({}, ({}));", number, written.substr(word.size()));
            at_ = semicolon + 1;
            return;
        }
        if (is_declaration(written)) {
            take(semicolon + 1 - at_);
            for (const std::string_view part : parts_of(written)) {
                const std::size_t equals = part.find('=');
                if (equals == std::string_view::npos) continue;
                const std::string_view name = last_word(part.substr(0, equals));
                note(step(KernelStep::Kind::value, begin, name, written), name);
            }
            return;
        }
        const auto assignment = assignment_in(written);
        if (!assignment) return take(semicolon + 1 - at_);
        // Braces keep it a single statement after an `if`.
        const std::string name(trimmed(std::string_view(written).substr(0, *assignment)));
        out_ += "{ ";
        take(semicolon + 1 - at_);
        note(step(KernelStep::Kind::value, begin, name, written), name);
        out_ += " }";
    }

    /// "vec3 r = …", "const float x = …", "float a, b".
    static bool is_declaration(std::string_view written) {
        const std::string_view first = first_word(written);
        if (first.empty()) return false;
        return !first_word(trimmed(written.substr(first.size()))).empty();
    }

    std::string raw_;   // as written
    std::string text_;  // without comments and preprocessor lines, for parsing
    std::string file_;
    std::vector<KernelStep>& steps_;
    std::size_t at_ = 0;
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
