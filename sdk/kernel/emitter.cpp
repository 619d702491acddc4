// Writes a kernel as text again, using only what was understood.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>

#include "builtins.h"
#include "candela/kernel_language/language.h"
#include "checker.h"

namespace candela::kernel_language {

namespace {

// Names in the language never begin with candela_. C++ leaves a conversion to int that is out of range, and
// some quotients of two ints, undefined, so that a compiler may draw far-reaching conclusions from them.
constexpr std::string_view k_guards =
    R"(KERNEL int candela_whole(float x) { return x > -2147483648.0f && x < 2147483648.0f ? int(x) : 0; }
KERNEL int candela_quotient(int a, int b) { return b == 0 ? 0 : (b == -1 ? -a : a / b); }
KERNEL int candela_remainder(int a, int b) { return b == 0 || b == -1 ? 0 : a % b; }
)";

bool is_in_word(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// How tightly an expression binds: the higher, the fewer parentheses.
int precedence_of(const Expression& expression) {
    if (expression.becomes_real) return 9;  // a call
    switch (expression.kind) {
        case Expression::Kind::conditional:
            return 0;
        case Expression::Kind::unary:
            return 7;
        case Expression::Kind::binary:
            break;
        default:
            return 9;
    }
    constexpr std::array<std::pair<std::string_view, int>, 13> k_precedences{{{"||", 1},
                                                                              {"&&", 2},
                                                                              {"==", 3},
                                                                              {"!=", 3},
                                                                              {"<", 4},
                                                                              {"<=", 4},
                                                                              {">", 4},
                                                                              {">=", 4},
                                                                              {"+", 5},
                                                                              {"-", 5},
                                                                              {"*", 6},
                                                                              {"/", 6},
                                                                              {"%", 6}}};
    for (const auto& [sign, precedence] : k_precedences)
        if (sign == expression.text) return precedence;
    return 0;
}

bool is_nonzero(const Expression& expression) {
    return expression.kind == Expression::Kind::integer &&
           expression.text.find_first_not_of('0') != std::string::npos;
}

/// "1.5e3" of "1.5e3f", "0.5" of ".5".
std::string canonical_real(std::string text) {
    if (text.ends_with('f') || text.ends_with('F')) text.pop_back();
    if (text.starts_with('.')) text.insert(0, "0");
    if (const std::size_t point = text.find('.');
        point != std::string::npos && (point + 1 == text.size() || !is_in_word(text[point + 1]) ||
                                       text[point + 1] == 'e' || text[point + 1] == 'E'))
        text.insert(point + 1, "0");
    return text + "f";
}

/// The name of a file, safe in a C++ string literal.
std::string safe_name(const std::string& name) {
    std::string result;
    for (const char c : name) result += is_in_word(c) || c == '.' || c == '-' ? c : '_';
    return result;
}

class Emitter {
  public:
    Emitter(const Kernel& kernel, Emission emission)
        : kernel_(kernel), guarded_(emission == Emission::guarded_cpp) {
        for (const Source& source : kernel.sources) {
            std::vector<std::size_t>& begins = line_begins_.emplace_back(1, 0);
            for (std::size_t i = 0; i < source.text.size(); ++i)
                if (source.text[i] == '\n') begins.push_back(i + 1);
        }
    }

    std::string text() {
        begin_source(0, 1);
        for (const Declaration& each : kernel_.declarations)
            std::visit([&](const auto& its) { declaration(its); }, each);
        out_ += '\n';
        if (!guarded_) return std::move(out_);
        std::string guards;
        // A macro would replace a name by its own text.
        for (const std::string& name : names_)
            guards += fmt::format("#ifdef {0}\n#error '{0}' is a macro of C++; choose another name\n#endif\n",
                                  name);
        return guards + std::string(k_guards) + out_;
    }

  private:
    // The position, in terms of its source, of what is written next.

    void begin_source(std::uint8_t source, std::size_t line) {
        source_ = source;
        line_ = line;
        column_ = 0;
        if (!out_.empty() && !out_.ends_with('\n')) out_ += '\n';
        if (guarded_) out_ += fmt::format("#line {} \"{}\"\n", line, safe_name(kernel_.sources[source].name));
    }

    std::size_t line_of(TextPosition place) const {
        const std::vector<std::size_t>& begins = line_begins_[place.source];
        return static_cast<std::size_t>(std::ranges::upper_bound(begins, place.offset) - begins.begin());
    }

    /// Advances to a position, if that is further on.
    void at(TextPosition place) {
        if (place.source != source_) return;
        const std::size_t line = line_of(place);
        const std::size_t column = place.offset - line_begins_[source_][line - 1];
        while (line_ < line) {
            out_ += '\n';
            ++line_;
            column_ = 0;
        }
        if (line_ > line || column_ >= column) return;
        out_.append(column - column_, ' ');
        column_ = column;
    }

    void put(std::string_view text) {
        const char last = out_.empty() ? '\n' : out_.back();
        constexpr std::string_view k_operators = "+-*/%<>=!&|?:";
        const bool glues = (is_in_word(last) && is_in_word(text.front())) ||
                           (k_operators.find(last) != std::string_view::npos &&
                            k_operators.find(text.front()) != std::string_view::npos);
        if (glues) {
            out_ += ' ';
            ++column_;
        }
        out_ += text;
        column_ += text.size();
    }

    void put(TextPosition place, std::string_view text) {
        at(place);
        put(text);
    }

    void name(TextPosition place, const std::string& text) {
        names_.insert(text);
        put(place, text);
    }

    void variable(const Variable& each) {
        if (each.is_constant) put("const");
        put(each.type.place, each.type.name);
        name(each.place, each.name);
    }

    void declaration(const Structure& structure) {
        put(structure.place, "struct");
        put(" ");
        name(structure.place, structure.name);
        put(" {");
        for (const Variable& member : structure.members) {
            variable(member);
            put(";");
        }
        put(structure.end, "}");
        put(";");
    }

    void declaration(const Constant& constant) { statement(constant.declaration); }

    void declaration(const Function& function) {
        put(function.place, "KERNEL");
        put(function.result.place, function.result.name);
        name(function.name_place, function.name);
        put("(");
        for (std::size_t i = 0; i < function.parameters.size(); ++i) {
            if (i > 0) put(", ");
            variable(function.parameters[i]);
        }
        put(")");
        put(function.begin, "{");
        const std::uint8_t outer = source_,
                           inner = function.body.empty() ? outer : function.body[0].place.source;
        if (inner != outer) begin_source(inner, 1);
        for (const Statement& each : function.body) statement(each);
        if (inner != outer) begin_source(outer, line_of(function.end));
        put(function.end, "}");
    }

    void block(const Statement& block) {
        put(block.place, "{");
        for (const Statement& each : block.statements) statement(each);
        put("}");
    }

    void statement(const Statement& statement) {
        at(statement.place);
        switch (statement.kind) {
            case Statement::Kind::block:
                return block(statement);
            case Statement::Kind::declare:
                declare(statement);
                return put(";");
            case Statement::Kind::assign:
                assign(statement);
                return put(";");
            case Statement::Kind::branch:
                put("if (");
                expression(statement.expressions.front());
                put(") ");
                block(statement.statements[0]);
                if (statement.statements.size() == 1) return;
                put(" else ");
                return block(statement.statements[1]);
            case Statement::Kind::loop:
                put("for (");
                declare(statement.statements[0]);
                put("; ");
                expression(statement.expressions.front());
                put("; ");
                assign(statement.statements[1]);
                put(") ");
                return block(statement.statements[2]);
            case Statement::Kind::result:
                put("return");
                put(" ");
                expression(statement.expressions.front());
                return put(";");
            case Statement::Kind::leave:
                return put("break;");
            case Statement::Kind::next:
                return put("continue;");
        }
    }

    void declare(const Statement& statement) {
        at(statement.place);
        if (statement.is_constant) put("const");
        put(statement.type.place, statement.type.name);
        name(statement.name_place, statement.name);
        if (!statement.expressions.empty()) {
            put(" = ");
            expression(statement.expressions.front());
        } else if (guarded_) {
            put(" = {}");
        }
    }

    void assign(const Statement& statement) {
        const Expression& target = statement.expressions.front();
        if (statement.expressions.size() == 1) put(statement.name);  // ++ and --
        expression(target);
        if (statement.expressions.size() == 1) return;
        const Expression& value = statement.expressions[1];
        const std::string& sign = statement.name;
        put(" ");
        if (guarded_ && target.type == k_int && (sign == "/=" || sign == "%=") && !is_nonzero(value)) {
            put(statement.name_place, "= ");
            put(sign == "/=" ? "candela_quotient(" : "candela_remainder(");
            expression(target);
            put(", ");
            expression(value);
            return put(")");
        }
        put(statement.name_place, sign);
        put(" ");
        expression(value);
    }

    /// Adds parentheses if it binds less tightly than `least`.
    void operand(const Expression& each, int least) {
        const bool is_loose = precedence_of(each) < least;
        if (is_loose) put("(");
        expression(each);
        if (is_loose) put(")");
    }

    void arguments(std::string_view opening, const std::vector<Expression>& all) {
        put(opening);
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (i > 0) put(", ");
            expression(all[i]);
        }
        put(")");
    }

    void expression(const Expression& each) {
        if (each.becomes_real && each.kind == Expression::Kind::integer)
            return put(each.place, each.text + ".0f");
        // Yields a C++ vector rather than a swizzle that converts to one.
        const bool is_built = guarded_ && is_swizzle(each);
        if (each.becomes_real) put("float(");
        if (is_built) put(fmt::format("{}(", name_of(each.type.kind)));
        plain(each);
        if (is_built) put(")");
        if (each.becomes_real) put(")");
    }

    void plain(const Expression& each) {
        switch (each.kind) {
            case Expression::Kind::integer:
            case Expression::Kind::boolean:
            case Expression::Kind::variable:
                return put(each.place, each.text);
            case Expression::Kind::real:
                return put(each.place, canonical_real(each.text));
            case Expression::Kind::member:
                operand(each.operands.front(), 9);
                put(".");
                return put(each.place, each.text);
            case Expression::Kind::index:
                operand(each.operands.front(), 9);
                put("[");
                expression(each.operands[1]);
                return put("]");
            case Expression::Kind::call:
                return call(each);
            case Expression::Kind::unary:
                put(each.place, each.text);
                return operand(each.operands.front(), 7);
            case Expression::Kind::binary:
                return binary(each);
            case Expression::Kind::conditional:
                operand(each.operands[0], 1);
                put(" ");
                put(each.place, "? ");
                expression(each.operands[1]);
                put(" : ");
                return expression(each.operands[2]);
        }
    }

    void call(const Expression& each) {
        const bool cuts =
            guarded_ && each.text == "int" && each.operands.size() == 1 && (each.operands[0].type == k_float);
        put(each.place, cuts ? std::string_view("candela_whole") : std::string_view(each.text));
        arguments("(", each.operands);
    }

    void binary(const Expression& each) {
        const std::string& sign = each.text;
        if (guarded_ && each.operands[0].type == k_int && each.operands[1].type == k_int &&
            (sign == "/" || sign == "%") && !is_nonzero(each.operands[1]))
            return arguments(sign == "/" ? "candela_quotient(" : "candela_remainder(", each.operands);
        const int precedence = precedence_of_sign(each);
        operand(each.operands[0], precedence);
        put(" ");
        put(each.place, sign);
        put(" ");
        operand(each.operands[1], precedence + 1);
    }

    static int precedence_of_sign(const Expression& each) {
        const Expression bare{.kind = each.kind, .text = each.text};
        return precedence_of(bare);
    }

    const Kernel& kernel_;
    bool guarded_;
    std::vector<std::vector<std::size_t>> line_begins_;
    std::set<std::string> names_;
    std::string out_;
    std::uint8_t source_ = 0;
    std::size_t line_ = 1, column_ = 0;  // from 1, from 0
};

}  // namespace

std::string emitted(const Kernel& kernel, Emission emission) { return Emitter(kernel, emission).text(); }

}  // namespace candela::kernel_language
