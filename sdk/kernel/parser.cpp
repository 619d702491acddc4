#include "parser.h"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <utility>

#include "token_reader.h"

namespace candela::kernel_language {

namespace {

using Kind = Statement::Kind;

constexpr std::array<std::string_view, 6> k_assignments = {"=", "+=", "-=", "*=", "/=", "%="};
constexpr const char* k_no_pointers = "the kernel language has neither pointers nor references";

class Parser {
  public:
    explicit Parser(const std::vector<Token>& tokens) : tokens_(tokens) {}

    std::vector<Declaration> kernel() {
        std::vector<Declaration> declarations;
        while (!tokens_.at_end()) {
            if (tokens_.is("struct")) {
                declarations.emplace_back(structure());
            } else if (tokens_.is("const")) {
                std::vector<Statement> each;
                declare(each);
                for (Statement& one : each) declarations.emplace_back(Constant{std::move(one)});
            } else if (tokens_.is("KERNEL")) {
                declarations.emplace_back(function());
            } else if (tokens_.is("}")) {
                TokenReader::refuse(tokens_.peek(), "this '}' has no opening '{'");
            } else {
                tokens_.refuse_next("a struct, a constant (const) or a function (KERNEL)");
            }
        }
        return declarations;
    }

    std::vector<Statement> body() {
        std::vector<Statement> statements;
        while (!tokens_.at_end()) {
            if (tokens_.is("}")) TokenReader::refuse(tokens_.peek(), "this '}' has no opening '{'");
            statement(statements);
        }
        return statements;
    }

  private:
    TypeName type() {
        const Token& token = tokens_.peek();
        if (token.text == "float" || token.text == "int" || token.text == "bool") {
            tokens_.take();
        } else {
            tokens_.expect_name("a type");
        }
        return {.name = std::string(token.text), .place = token.place};
    }

    Structure structure() {
        const Token& word = tokens_.take();
        Structure result{.name = {}, .place = word.place};
        result.name = std::string(tokens_.expect_new_name("the struct's name").text);
        const Token& open = tokens_.expect("{");
        while (!tokens_.is("}")) {
            if (tokens_.at_end()) tokens_.expect_closing(open);
            const TypeName of_all = type();
            do {
                const Token& name = tokens_.expect_new_name("a member's name");
                result.members.push_back(
                    {.type = of_all, .name = std::string(name.text), .place = name.place});
            } while (tokens_.skip(","));
            tokens_.expect(";");
        }
        result.end = tokens_.take().place;
        tokens_.expect(";");
        return result;
    }

    Function function() {
        Function result{.place = tokens_.take().place};
        result.result = type();
        const Token& name = tokens_.expect_new_name("the function's name");
        result.name = std::string(name.text);
        result.name_place = name.place;
        const Token& open = tokens_.expect("(");
        if (!tokens_.is(")")) {
            do {
                const bool is_constant = tokens_.skip("const");
                if (tokens_.is("in") || tokens_.is("out") || tokens_.is("inout"))
                    TokenReader::refuse(tokens_.peek(),
                                        "arguments are values, and functions return their result; 'in', "
                                        "'out' and 'inout' do not exist");
                const TypeName its_type = type();
                const Token& its_name = tokens_.expect_new_name("the argument's name");
                result.parameters.push_back({.is_constant = is_constant,
                                             .type = its_type,
                                             .name = std::string(its_name.text),
                                             .place = its_name.place});
            } while (tokens_.skip(","));
        }
        if (tokens_.at_end()) TokenReader::refuse(open, "this '(' is not closed");
        if (!tokens_.skip(")")) tokens_.refuse_next("',' or ')'");
        const Token& brace = tokens_.expect("{");
        result.begin = brace.place;
        result.end = statements_until(brace, result.body);
        return result;
    }

    /// Parses statements in braces whose opening brace has been read. Returns the position of the closing
    /// one.
    TextPosition statements_until(const Token& open, std::vector<Statement>& statements) {
        const TokenReader::Level level(tokens_);
        while (!tokens_.is("}")) {
            if (tokens_.at_end()) TokenReader::refuse(open, "this '{' is not closed");
            statement(statements);
        }
        return tokens_.take().place;
    }

    void statement(std::vector<Statement>& to) {
        const Token& token = tokens_.peek();
        if (tokens_.skip(";")) return;
        if (token.text == "{" && token.kind == Token::Kind::sign) {
            tokens_.take();
            Statement block{.kind = Kind::block, .place = token.place};
            statements_until(token, block.statements);
            to.push_back(std::move(block));
        } else if (token.text == "if") {
            to.push_back(branch());
        } else if (token.text == "for") {
            to.push_back(loop());
        } else if (token.text == "return") {
            tokens_.take();
            Statement result{.kind = Kind::result, .place = token.place};
            result.expressions.push_back(parsed_expression(tokens_));
            tokens_.expect(";", "an operator or ");
            to.push_back(std::move(result));
        } else if (token.text == "break" || token.text == "continue") {
            tokens_.take();
            tokens_.expect(";");
            to.push_back({.kind = token.text == "break" ? Kind::leave : Kind::next, .place = token.place});
        } else if (token.text == "else") {
            TokenReader::refuse(token, "this 'else' has no 'if'");
        } else if (token.text == "struct") {
            TokenReader::refuse(token, "the kernel language has no 'struct' in a function");
        } else if (begins_declaration()) {
            declare(to);
        } else {
            to.push_back(assignment());
            tokens_.expect(";", "an operator or ");
        }
    }

    bool begins_declaration() const {
        const Token& token = tokens_.peek();
        if (token.kind != Token::Kind::name) return false;
        return token.text == "const" || token.text == "float" || token.text == "int" ||
               token.text == "bool" || tokens_.peek(1).kind == Token::Kind::name;
    }

    /// "const float a = 1.0f, b = 2.0f;", as one statement per name.
    void declare(std::vector<Statement>& to) {
        const TextPosition place = tokens_.peek().place;
        const bool is_constant = tokens_.skip("const");
        const TypeName its_type = type();
        do {
            const Token& name = tokens_.expect_new_name("a name for the variable");
            Statement result{.kind = Kind::declare,
                             .place = place,
                             .is_constant = is_constant,
                             .type = its_type,
                             .name = std::string(name.text),
                             .name_place = name.place};
            if (tokens_.skip("=")) {
                result.expressions.push_back(parsed_expression(tokens_));
            } else if (is_constant) {
                tokens_.refuse_next("'=' and the constant's value");
            } else if (!tokens_.is(",") && !tokens_.is(";")) {
                tokens_.refuse_next(tokens_.is("(") || tokens_.is("{") ? "'=' and a value" : "'=' or ';'");
            }
            to.push_back(std::move(result));
        } while (tokens_.skip(","));
        tokens_.expect(";", "an operator or ");
    }

    static Statement change(const Token& first, const Token& sign, Expression target) {
        Statement result{.kind = Kind::assign, .place = first.place, .name = std::string(sign.text)};
        result.name_place = sign.place;
        result.expressions.push_back(std::move(target));
        return result;
    }

    /// "a.x = 1.0f", "a += b", "i++", "++i".
    Statement assignment() {
        const Token& first = tokens_.peek();
        if (first.text == "++" || first.text == "--") {
            const Token& sign = tokens_.take();
            return change(first, sign, target());
        }
        if (first.text == "*") TokenReader::refuse(first, k_no_pointers);
        if (first.kind != Token::Kind::name) tokens_.refuse_next("a statement");
        Expression what = target();
        const Token& sign = tokens_.peek();
        if (sign.text == "++" || sign.text == "--") return change(first, tokens_.take(), std::move(what));
        if ((sign.text == "*" || sign.text == "&&") && what.kind == Expression::Kind::variable)
            TokenReader::refuse(sign, k_no_pointers);
        if (sign.text == "(")
            TokenReader::refuse(
                first, "a call alone has no effect, since functions only return values; assign or return it");
        if (sign.text == ":") TokenReader::refuse(first, "the kernel language has no labels");
        for (const std::string_view known : k_assignments) {
            if (sign.kind != Token::Kind::sign || sign.text != known) continue;
            Statement result = change(first, tokens_.take(), std::move(what));
            result.expressions.push_back(parsed_expression(tokens_));
            return result;
        }
        tokens_.refuse_next("an assignment, such as '=' or '+=',");
    }

    /// A variable, or a member of one.
    Expression target() {
        const Token& name = tokens_.expect_name("a variable");
        Expression result{
            .kind = Expression::Kind::variable, .place = name.place, .text = std::string(name.text)};
        while (tokens_.skip(".")) {
            const Token& member = tokens_.expect_name("the name of a member");
            Expression of_it{
                .kind = Expression::Kind::member, .place = member.place, .text = std::string(member.text)};
            of_it.depth = result.depth + 1;
            if (of_it.depth > 16) TokenReader::refuse(member, "structs are not nested this deeply");
            of_it.operands.push_back(std::move(result));
            result = std::move(of_it);
        }
        return result;
    }

    /// The body of a condition or a loop, always as a block.
    Statement dependent() {
        Statement block{.kind = Kind::block, .place = tokens_.peek().place};
        if (tokens_.is("{")) {
            const Token& open = tokens_.take();
            statements_until(open, block.statements);
        } else {
            const TokenReader::Level level(tokens_);
            if (tokens_.at_end()) tokens_.refuse_next("a statement");
            statement(block.statements);
        }
        return block;
    }

    Statement branch() {
        Statement result{.kind = Kind::branch, .place = tokens_.take().place};
        const Token& open = tokens_.expect("(");
        result.expressions.push_back(parsed_expression(tokens_));
        tokens_.expect_closing(open);
        result.statements.push_back(dependent());
        if (tokens_.skip("else")) result.statements.push_back(dependent());
        return result;
    }

    Statement loop() {
        Statement result{.kind = Kind::loop, .place = tokens_.take().place};
        const Token& open = tokens_.expect("(");
        if (!tokens_.is("int")) tokens_.refuse_next("a loop's variable, as in for (int i = 0; i < 8; ++i),");
        declare(result.statements);
        if (result.statements.size() != 1)
            TokenReader::refuse(open, "a loop has one variable, as in for (int i = 0; i < 8; ++i)");
        result.expressions.push_back(parsed_expression(tokens_));
        tokens_.expect(";", "an operator or ");
        result.statements.push_back(assignment());
        tokens_.expect_closing(open);
        result.statements.push_back(dependent());
        return result;
    }

    TokenReader tokens_;
};

}  // namespace

std::vector<Declaration> parsed_kernel(const std::vector<Token>& tokens) { return Parser(tokens).kernel(); }

std::vector<Statement> parsed_body(const std::vector<Token>& tokens) { return Parser(tokens).body(); }

}  // namespace candela::kernel_language
