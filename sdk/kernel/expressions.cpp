// The parser of expressions: by precedence, without recursion for operators of one level.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "candela/kernel_language/language.h"
#include "parser.h"
#include "token_reader.h"

namespace candela::kernel_language {

namespace {

using Kind = Expression::Kind;

constexpr const char* k_no_pointers = "the kernel language has neither pointers nor references";

/// From the loosest to the tightest.
constexpr std::array<std::array<std::string_view, 4>, 6> k_levels{
    {{"||"}, {"&&"}, {"==", "!="}, {"<", "<=", ">", ">="}, {"+", "-"}, {"*", "/", "%"}}};

bool is_type_keyword(std::string_view word) { return word == "float" || word == "int" || word == "bool"; }

class ExpressionParser {
  public:
    explicit ExpressionParser(TokenReader& tokens) : tokens_(tokens) {}

    Expression conditional() {
        const TokenReader::Level level(tokens_);
        Expression condition = binary(0);
        if (!tokens_.is("?")) return condition;
        const Token& sign = tokens_.take();
        Expression if_true = conditional();
        tokens_.expect(":", "an operator or ");
        Expression if_false = conditional();
        return node(Kind::conditional, sign, {std::move(condition), std::move(if_true), std::move(if_false)});
    }

  private:
    static Expression node(Kind kind, const Token& token, std::vector<Expression> operands) {
        Expression result{.kind = kind, .place = token.place, .text = std::string(token.text)};
        for (const Expression& operand : operands) result.depth = std::max(result.depth, operand.depth + 1);
        if (result.depth > k_deepest_expression)
            TokenReader::refuse(
                token,
                fmt::format("more than {} operations depend on one another here; give a part of them a name",
                            k_deepest_expression));
        result.operands = std::move(operands);
        return result;
    }

    static std::vector<Expression> both(Expression left, Expression right) {
        std::vector<Expression> operands;
        operands.push_back(std::move(left));
        operands.push_back(std::move(right));
        return operands;
    }

    static std::vector<Expression> only(Expression operand) {
        std::vector<Expression> operands;
        operands.push_back(std::move(operand));
        return operands;
    }

    bool is_operator(std::size_t level) const {
        const Token& token = tokens_.peek();
        return token.kind == Token::Kind::sign &&
               std::ranges::find(k_levels[level], token.text) != k_levels[level].end();
    }

    Expression binary(std::size_t level) {
        if (level == k_levels.size()) return unary();
        Expression left = binary(level + 1);
        while (is_operator(level)) {
            const Token& sign = tokens_.take();
            Expression right = binary(level + 1);
            left = node(Kind::binary, sign, both(std::move(left), std::move(right)));
        }
        return left;
    }

    Expression unary() {
        if (tokens_.is("*") || tokens_.is("&&")) TokenReader::refuse(tokens_.peek(), k_no_pointers);
        if (tokens_.is("+")) {
            const TokenReader::Level level(tokens_);
            tokens_.take();
            return unary();
        }
        if (tokens_.is("-") || tokens_.is("!")) {
            const TokenReader::Level level(tokens_);
            const Token& sign = tokens_.take();
            return node(Kind::unary, sign, only(unary()));
        }
        return postfix();
    }

    Expression postfix() {
        Expression operand = primary();
        while (tokens_.is(".") || tokens_.is("[")) {
            if (tokens_.is("[")) {
                const Token& open = tokens_.take();
                Expression index = conditional();
                tokens_.expect_closing(open);
                operand = node(Kind::index, open, both(std::move(operand), std::move(index)));
                continue;
            }
            tokens_.take();
            const Token& name = tokens_.expect_name("the name of a member");
            operand = node(Kind::member, name, only(std::move(operand)));
        }
        return operand;
    }

    Expression primary() {
        const Token& token = tokens_.peek();
        if (token.kind == Token::Kind::integer) return node(Kind::integer, tokens_.take(), {});
        if (token.kind == Token::Kind::real) return node(Kind::real, tokens_.take(), {});
        if (token.text == "(" && token.kind == Token::Kind::sign) {
            const Token& open = tokens_.take();
            Expression inner = conditional();
            tokens_.expect_closing(open);
            if (tokens_.peek().kind == Token::Kind::name || tokens_.peek().kind == Token::Kind::integer ||
                tokens_.peek().kind == Token::Kind::real)
                TokenReader::refuse(
                    tokens_.peek(),
                    fmt::format(
                        "expected an operator or ';' before '{}'; convert types with float(x) or int(x)",
                        tokens_.peek().text));
            return inner;
        }
        if (token.kind != Token::Kind::name) tokens_.refuse_next("a value");
        if (token.text == "true" || token.text == "false") return node(Kind::boolean, tokens_.take(), {});
        const bool is_call = tokens_.peek(1).text == "(";
        if (is_type_keyword(token.text)) {
            if (!is_call)
                TokenReader::refuse(token,
                                    fmt::format("'{0}' is a type; convert a value with {0}(x)", token.text));
            return call(tokens_.take());
        }
        const Token& name = tokens_.expect_name("a value");
        return is_call ? call(name) : node(Kind::variable, name, {});
    }

    Expression call(const Token& name) {
        const Token& open = tokens_.take();
        std::vector<Expression> arguments;
        if (!tokens_.is(")")) {
            do arguments.push_back(conditional());
            while (tokens_.skip(","));
        }
        tokens_.expect_closing(open);
        return node(Kind::call, name, std::move(arguments));
    }

    TokenReader& tokens_;
};

}  // namespace

Expression parsed_expression(TokenReader& tokens) { return ExpressionParser(tokens).conditional(); }

}  // namespace candela::kernel_language
