// The checker of statements: which variables are assigned when, and that all loops end.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "candela/kernel_language/language.h"
#include "checker.h"

namespace candela::kernel_language {

namespace {

using Kind = Statement::Kind;

constexpr const char* k_loop_form =
    "a loop needs a constant bound, as in for (int i = 0; i < 8; ++i), or i < min(n, 8)";

std::vector<bool> both(const std::vector<bool>& a, const std::vector<bool>& b) {
    std::vector<bool> result(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) result[i] = a[i] && i < b.size() && b[i];
    return result;
}

}  // namespace

void Checker::statements(std::vector<Statement>& all) {
    for (Statement& each : all) statement(each);
}

void Checker::in_scope(Statement& block) {
    open_scope();
    statements(block.statements);
    close_scope();
}

void Checker::statement(Statement& statement) {
    count(1, 1, statement.place);
    switch (statement.kind) {
        case Kind::block:
            return in_scope(statement);
        case Kind::declare:
            return declare(statement);
        case Kind::assign:
            return assign(statement);
        case Kind::branch:
            return branch(statement);
        case Kind::loop:
            return loop(statement);
        case Kind::result:
            check_as(statement.expressions.front(), result_, fmt::format("{}() returns", function_));
            is_reachable_ = false;
            return;
        case Kind::leave:
        case Kind::next:
            if (loops_ == 0)
                throw Refusal{statement.place,
                              fmt::format("this '{}' is not in a loop",
                                          statement.kind == Kind::leave ? "break" : "continue")};
            is_reachable_ = false;
            return;
    }
}

void Checker::declare(Statement& statement) {
    resolve(statement.type);
    Seen seen{.type = statement.type.type, .is_constant = statement.is_constant};
    const bool has_value = !statement.expressions.empty();
    if (has_value) {
        Expression& value = statement.expressions.front();
        being_declared_ = statement.name;
        check_as(value, seen.type, fmt::format("'{}' is", statement.name));
        being_declared_.clear();
        if (statement.is_constant && seen.type == k_int) seen.value = value_of(value);
    }
    count(0, numbers_in(seen.type), statement.name_place);
    see(statement.name, statement.name_place, seen, has_value);
}

void Checker::assign(Statement& statement) {
    // Only the operator remains to be checked; the statement may be the variable's first assignment.
    std::string path;
    Expression* root = &statement.expressions.front();
    while (root->kind == Expression::Kind::member) {
        path.insert(0, "." + root->text);
        root = &root->operands.front();
    }
    const std::size_t* const found = seen_as(root->text);
    if (found == nullptr) refuse_unknown(*root);
    const std::size_t number = *found;
    const Seen& target = seen_[number];
    if (target.counts_a_loop)
        throw Refusal{
            root->place,
            fmt::format("'{}' is a loop's counter and must not be assigned to within it", root->text)};
    if (target.is_constant)
        throw Refusal{root->place, fmt::format("'{}' is a constant and cannot be assigned to", root->text)};
    const std::string& sign = statement.name;
    const bool reads = sign != "=";
    const bool was_assigned = assigned_[number];
    if (!reads) assigned_[number] = true;  // while its path is checked
    const Type type = check(statement.expressions.front());
    assigned_[number] = was_assigned;
    if (is_swizzle(statement.expressions.front()))
        throw Refusal{statement.place,
                      "assigning to several components at once is not allowed; assign each, as in v.x = "
                      "1.0f, or the whole vector"};
    if (statement.expressions.size() == 1) {  // ++ and --
        if (type != k_int && type != k_float)
            throw Refusal{statement.name_place,
                          fmt::format("'{}' is for numbers, but this is a {}", sign, text_of(type))};
        return;
    }
    Expression& value = statement.expressions[1];
    if (!reads) {
        check_as(value, type, fmt::format("'{}{}' is", root->text, path));
        assigned_[number] = true;
        return;
    }
    if (components_of(type) > 0 && sign != "%=") {
        const Type given = check(value);
        if (given == k_int) check_as(value, k_float, "this is");
        if (given != type && given != k_float && given != k_int)
            throw Refusal{statement.name_place,
                          fmt::format("'{}' does not take {} and {}", sign, text_of(type), text_of(given))};
        return;
    }
    if (type != k_int && type != k_float)
        throw Refusal{statement.name_place,
                      fmt::format("'{}' is not for a {}; write a = a {} b, if that exists", sign,
                                  text_of(type), sign.substr(0, 1))};
    if (sign == "%=" && type != k_int)
        throw Refusal{statement.name_place, "'%=' is for int; the remainder of floats is mod(x, y)"};
    check_as(value, type, fmt::format("'{}{}' is", root->text, path));
}

void Checker::branch(Statement& statement) {
    check_as(statement.expressions.front(), k_bool, "a condition is");
    const std::vector<bool> before = assigned_;
    const bool was_reachable = is_reachable_;
    in_scope(statement.statements[0]);
    std::vector<bool> if_true = std::exchange(assigned_, before);
    const bool true_ends = std::exchange(is_reachable_, was_reachable);
    assigned_.resize(seen_.size());
    if (statement.statements.size() > 1) in_scope(statement.statements[1]);
    // Only paths that continue count.
    if (!is_reachable_) {
        assigned_ = std::move(if_true);
        assigned_.resize(seen_.size());
    } else if (true_ends) {
        assigned_ = both(assigned_, if_true);
    }
    is_reachable_ = is_reachable_ || true_ends;
}

void Checker::loop(Statement& statement) {
    open_scope();
    Statement& counter = statement.statements[0];
    declare(counter);
    const std::size_t number = seen_.size() - 1;
    check_as(statement.expressions.front(), k_bool, "a loop's condition is");
    Statement& step = statement.statements[1];
    assign(step);
    const std::uint64_t times = iterations_of(statement);
    const std::uint64_t around = iterations_;
    if (times * around > k_most_iterations)
        throw Refusal{statement.place,
                      fmt::format("this loop's body is run {} times{}; at most {} are allowed", times,
                                  around > 1 ? fmt::format(", in loops that run {} times", around) : "",
                                  k_most_iterations)};
    seen_[number].counts_a_loop = true;
    iterations_ *= std::max<std::uint64_t>(times, 1);
    const std::uint64_t steps_before = std::exchange(steps_, 0);
    const std::vector<bool> before = assigned_;
    const bool was_reachable = is_reachable_;
    ++loops_;
    statements(statement.statements[2].statements);  // in the scope of the counter
    --loops_;
    iterations_ = around;
    // The body may not have run at all.
    assigned_ = before;
    assigned_.resize(seen_.size());
    is_reachable_ = was_reachable;
    const std::uint64_t once = steps_ + 3;
    steps_ = steps_before;
    count(once * (times + 1), 0, statement.place);
    close_scope();
}

std::uint64_t Checker::iterations_of(const Statement& loop) const {
    const Statement& counter = loop.statements[0];
    const Expression& condition = loop.expressions.front();
    const Statement& step = loop.statements[1];
    const auto is_counter = [&](const Expression& expression) {
        return expression.kind == Expression::Kind::variable && expression.text == counter.name;
    };
    const auto first = counter.expressions.empty() ? std::nullopt : value_of(counter.expressions.front());
    if (!first || counter.is_constant)
        throw Refusal{counter.place, std::string("a loop must begin at a constant; ") + k_loop_form};
    if (!is_counter(step.expressions.front()))
        throw Refusal{step.place, fmt::format("the step of a loop must change its variable '{}'; {}",
                                              counter.name, k_loop_form)};
    std::optional<std::int64_t> width = 1;
    if (step.expressions.size() > 1) width = value_of(step.expressions[1]);
    const bool is_sum = step.name == "++" || step.name == "--" || step.name == "+=" || step.name == "-=";
    if (!is_sum || !width || *width == 0)
        throw Refusal{step.name_place,
                      std::string("a loop's step must be ++i, --i, i += 2 or i -= 2; ") + k_loop_form};
    if (step.name.starts_with('-')) width = -*width;
    const std::string& compared = condition.text;
    const bool goes_up = compared == "<" || compared == "<=", goes_down = compared == ">" || compared == ">=";
    if (condition.kind != Expression::Kind::binary || !(goes_up || goes_down) ||
        !is_counter(condition.operands.front()))
        throw Refusal{condition.place, k_loop_form};
    // "min(n, 8)" is at most 8.
    const Expression& limit = condition.operands[1];
    std::optional<std::int64_t> last = value_of(limit);
    const char* const bounding = goes_up ? "min" : "max";
    if (!last && limit.kind == Expression::Kind::call && limit.text == bounding &&
        limit.operands.size() == 2 && limit.type == k_int) {
        for (const Expression& operand : limit.operands)
            if (const auto value = value_of(operand)) last = value;
    }
    if (!last || limit.type != k_int) throw Refusal{limit.place, k_loop_form};
    if ((*width > 0) != goes_up)
        throw Refusal{step.name_place,
                      fmt::format("this loop does not end: it counts away from its bound {}", *last)};
    const std::int64_t distance = (goes_up ? *last - *first : *first - *last) + (compared.size() > 1 ? 1 : 0);
    const std::int64_t stride = std::abs(*width);
    const std::int64_t times = distance <= 0 ? 0 : (distance + stride - 1) / stride;
    // At the end, a counter must still be an int.
    constexpr std::int64_t k_largest = 2147483647;
    if (std::abs(*last) + 1 + stride > k_largest)
        throw Refusal{limit.place,
                      fmt::format("a loop's bound must be between -{0} and {0}", k_largest - 1 - stride)};
    return static_cast<std::uint64_t>(times);
}

}  // namespace candela::kernel_language
