#include "documentation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "tokens.h"

import candela.api;
import candela.util;

namespace candela::kernel_language {

namespace {

using Kind = Type::Kind;

constexpr std::string_view k_blanks = " \t\r";

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(k_blanks);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(k_blanks) - begin + 1);
}

/// The comment that begins at `offset`, up to the end of its line.
CommentText comment_line(std::string_view kernel, std::size_t offset) {
    const std::string_view line = kernel.substr(offset, kernel.find('\n', offset) - offset);
    const std::string_view text = trimmed(line.substr(3));
    return {text, text.empty() ? offset : static_cast<std::size_t>(text.data() - kernel.data())};
}

/// The offset of the /// that is the first thing on the line at `line`; npos if something else is there.
std::size_t comment_alone(std::string_view kernel, std::size_t line) {
    const std::size_t begin = kernel.find_first_not_of(" \t", line);
    return begin != std::string_view::npos && kernel.substr(begin, 3) == "///" ? begin
                                                                               : std::string_view::npos;
}

std::size_t next_line(std::string_view kernel, std::size_t offset) {
    const std::size_t end = kernel.find('\n', offset);
    return end == std::string_view::npos ? kernel.size() : end + 1;
}

void append_comments(std::string_view kernel, std::size_t line, std::vector<CommentText>& comment) {
    for (; line < kernel.size(); line = next_line(kernel, line)) {
        const std::size_t begin = comment_alone(kernel, line);
        if (begin == std::string_view::npos) return;
        comment.push_back(comment_line(kernel, begin));
    }
}

/// Reads a comment word by word.
class CommentReader {
  public:
    explicit CommentReader(const CommentText& line) : comment_(line), line_(line.text()) {}

    bool at_end() {
        skip_blanks();
        return at_ >= line_.size();
    }
    /// Of what is next.
    TextPosition next_place() {
        skip_blanks();
        return comment_.place(at_);
    }
    [[noreturn]] void refuse(const std::string& message) { throw Refusal{next_place(), message}; }
    bool is(std::string_view text) {
        skip_blanks();
        return line_.substr(at_).starts_with(text);
    }
    bool skip(std::string_view text) {
        if (!is(text)) return false;
        at_ += text.size();
        return true;
    }
    /// Skips a word if it is the next one, as a whole.
    bool skip_word(std::string_view word) {
        const std::size_t before = at_;
        if (!at_end() && this->word() == word) return true;
        at_ = before;
        return false;
    }
    /// Letters, digits, - and _; empty if something else is next.
    std::string_view word() {
        skip_blanks();
        const std::size_t begin = at_;
        const auto is_part = [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                   c == '_';
        };
        while (at_ < line_.size() && is_part(line_[at_])) ++at_;
        return line_.substr(begin, at_ - begin);
    }
    bool number(float& value) {
        skip_blanks();
        const std::string rest(line_.substr(at_));
        if (rest.empty() || (std::string_view("+-.0123456789").find(rest[0]) == std::string_view::npos))
            return false;
        char* end = nullptr;
        value = std::strtof(rest.c_str(), &end);
        if (end == rest.c_str()) return false;
        at_ += static_cast<std::size_t>(end - rest.c_str());
        return true;
    }
    /// The text up to `end`, which is skipped; refuses a line that does not have it.
    std::string_view until(std::string_view end, const char* wanted) {
        skip_blanks();
        const std::size_t found = line_.find(end, at_);
        if (found == std::string_view::npos) refuse(fmt::format("expected {}", wanted));
        const std::string_view text = trimmed(line_.substr(at_, found - at_));
        at_ = found + end.size();
        return text;
    }
    std::string_view rest() {
        skip_blanks();
        return line_.substr(std::exchange(at_, line_.size()));
    }

  private:
    void skip_blanks() {
        while (at_ < line_.size() && k_blanks.find(line_[at_]) != std::string_view::npos) ++at_;
    }

    const CommentText& comment_;
    std::string_view line_;
    std::size_t at_ = 0;
};

// The description of a model.

std::vector<float> read_numbers(CommentReader& line) {
    std::vector<float> numbers;
    for (float number = 0; line.number(number);) numbers.push_back(number);
    if (numbers.empty()) line.refuse("expected a number");
    return numbers;
}

/// "kd + ks <= 1 because …", "inner < outer because …".
RelationDeclaration read_relation(CommentReader line, bool only_warns) {
    RelationDeclaration relation{.only_warns = only_warns, .place = line.next_place()};
    constexpr const char* k_forms = "'a <= b because …', 'a < b because …' or 'a + b <= 1 because …'";
    relation.left = line.word();
    if (line.skip("+")) {
        relation.type = RelationType::sum_at_most_one;
        relation.right = line.word();
        float one = 0;
        if (!line.skip("<=") || !line.number(one) || one != 1)
            line.refuse(fmt::format("expected {}", k_forms));
    } else if (line.skip("<=")) {
        relation.right = line.word();
    } else if (line.skip("<")) {
        relation.type = RelationType::less;
        relation.right = line.word();
    }
    if (relation.left.empty() || relation.right.empty() ||
        !(line.skip_word("because") || line.skip_word("or")) || line.at_end())
        line.refuse(fmt::format("expected {}", k_forms));
    relation.meaning = line.rest();
    return relation;
}

/// "brass (author, year, title): ka = 0.3 0.2 0.03, shininess = 28, color = 255 255 255".
PresetDeclaration read_preset(CommentReader line) {
    PresetDeclaration preset{.place = line.next_place()};
    preset.name = line.until("(", "'name (source): parameter = numbers, …'");
    preset.source = line.until("):", "'):' after the source");
    do {
        const std::string parameter(line.word());
        if (parameter.empty() || !line.skip("=")) line.refuse("expected 'parameter = numbers'");
        std::vector<float> numbers = read_numbers(line);
        if (parameter == "color")
            preset.color = std::move(numbers);
        else
            preset.values.emplace_back(parameter, std::move(numbers));
    } while (line.skip(","));
    if (!line.at_end()) line.refuse("expected ',' or the end of the line");
    return preset;
}

void read_properties(CommentReader line, ModelDeclaration& model) {
    do {
        PropertyDeclaration property{.place = line.next_place()};
        property.name = line.word();
        if (property.name.empty()) line.refuse("expected the name of a property");
        if (line.skip("=")) {
            property.value = line.word();
            for (std::string_view word = line.word(); !word.empty(); word = line.word())
                property.value += fmt::format(" {}", word);
        }
        model.properties.push_back(std::move(property));
    } while (line.skip(","));
    if (!line.at_end()) line.refuse("expected ',' or the end of the line");
}

std::string read_one_of(CommentReader line, std::initializer_list<std::string_view> words) {
    for (const std::string_view word : words)
        if (line.skip_word(word) && line.at_end()) return std::string(word);
    line.refuse(fmt::format("expected {}", fmt::join(words, " or ")));
}

constexpr std::array<std::string_view, 7> k_keywords = {
    "reference:", "properties:", "requires:", "expects:", "presets:", "preset:", "rate:"};

/// The keyword that begins a part of the description; empty if it is prose.
std::string_view keyword_of(std::string_view line) {
    for (const std::string_view other : {"# ", "$$"})
        if (line.starts_with(other)) return other;
    for (const std::string_view keyword : k_keywords)
        if (line.starts_with(keyword)) return keyword;
    return {};
}

/// An equation between $$ and $$.
void read_equation(const CommentText& part, ModelDeclaration& model) {
    const std::string_view text = std::string_view(part.text()).substr(2);
    const std::size_t end = text.find("$$");
    if (end == std::string_view::npos) throw Refusal{part.place(), "this equation has no closing $$"};
    if (end + 2 != text.size())
        throw Refusal{part.place(end + 4), "expected a line of its own after an equation"};
    const std::string_view tex = trimmed(text.substr(0, end));
    try {
        static_cast<void>(plain_text(tex));
    } catch (const EquationProblem& problem) {
        const auto begin = static_cast<std::size_t>(tex.data() - part.text().data());
        throw Refusal{part.place(begin + problem.offset()), problem.what()};
    }
    model.formula.emplace_back(tex);
}

void read_part(const CommentText& part, ModelDeclaration& model) {
    CommentReader line(part);
    if (line.skip("# ")) {
        if (!model.title.empty()) throw Refusal{part.place(), "the model has a title already"};
        model.title = line.rest();
    } else if (line.is("$$")) {
        read_equation(part, model);
    } else if (line.skip("reference:")) {
        model.reference = line.rest();
    } else if (line.skip("properties:")) {
        read_properties(line, model);
    } else if (line.skip("requires:")) {
        model.relations.push_back(read_relation(line, false));
    } else if (line.skip("expects:")) {
        model.relations.push_back(read_relation(line, true));
    } else if (line.skip("presets:")) {
        model.preset_set_place = part.place();
        model.preset_set = read_one_of(line, {"classic", "metals"});
    } else if (line.skip("preset:")) {
        model.presets.push_back(read_preset(line));
    } else if (line.skip("rate:")) {
        model.rate_place = part.place();
        model.rate = read_one_of(line, {"face", "vertex", "fragment"});
    } else if (model.summary.empty()) {
        model.summary = line.rest();
    } else {
        model.description.emplace_back(line.rest());
    }
}

// The declaration of a parameter.

constexpr std::array<std::pair<std::string_view, ParamType>, 6> k_type_words{
    {{"color", ParamType::color},
     {"point", ParamType::point},
     {"direction", ParamType::direction},
     {"vector", ParamType::vector},
     {"bool", ParamType::boolean},
     {"numbers", ParamType::numbers}}};

std::optional<ParamType> usual_type(Kind kind) {
    switch (kind) {
        case Kind::real:
            return ParamType::real;
        case Kind::integer:
            return ParamType::integer;
        case Kind::vec3:
            return ParamType::rgb;
        case Kind::mat3:
            return ParamType::matrix;
        case Kind::table:
            return ParamType::numbers;
        default:
            return std::nullopt;
    }
}

bool fits(ParamType type, Kind kind) {
    switch (type) {
        case ParamType::boolean:
            return kind == Kind::integer;
        case ParamType::numbers:
            return kind == Kind::table;
        default:
            return usual_type(kind) == type || (kind == Kind::vec3 && type != ParamType::real &&
                                                type != ParamType::integer && type != ParamType::matrix);
    }
}

void read_default(CommentReader& line, ParameterDeclaration& parameter) {
    parameter.default_place = line.next_place();
    if (parameter.type == ParamType::boolean) {
        const std::string_view word = line.word();
        if (word != "true" && word != "false") line.refuse("expected true or false");
        parameter.numbers = {word == "true" ? 1.0f : 0.0f};
        return;
    }
    if (float number = 0; parameter.type == ParamType::integer && !CommentReader(line).number(number)) {
        parameter.type = ParamType::choice;
        do {
            parameter.choices.emplace_back(line.word());
            if (parameter.choices.back().empty()) line.refuse("expected a word: 'a | b | c'");
        } while (line.skip("|"));
        return;
    }
    parameter.numbers = read_numbers(line);
    const std::size_t count = parameter.numbers.size();
    if (parameter.type == ParamType::rgb && count == 1)
        parameter.numbers.resize(3, parameter.numbers.front());
    const std::size_t wanted = parameter.type == ParamType::matrix    ? 9
                               : parameter.type == ParamType::numbers ? count
                               : parameter.type == ParamType::real || parameter.type == ParamType::integer
                                   ? 1
                                   : 3;
    if (parameter.numbers.size() != wanted)
        throw Refusal{parameter.default_place,
                      fmt::format("expected {} {} as the default of '{}', got {}", wanted,
                                  wanted == 1 ? "number" : "numbers", parameter.name, count)};
}

/// "[0, 1]", "(0, inf)", "[0, 90)".
void read_range(CommentReader& line, ParameterDeclaration& parameter) {
    parameter.range_place = line.next_place();
    const bool excludes_minimum = line.is("(");
    if (!line.skip("[") && !line.skip("(")) return;
    const auto bound = [&](float infinite) {
        float number = infinite;
        if (!line.skip("-inf") && !line.skip("inf") && !line.number(number))
            line.refuse("expected a number, inf or -inf");
        return number;
    };
    parameter.minimum = bound(k_no_minimum);
    if (!line.skip(",")) line.refuse("expected ',' and the upper bound");
    parameter.maximum = bound(k_no_maximum);
    parameter.minimum_excluded = excludes_minimum && std::isfinite(parameter.minimum);
    parameter.maximum_excluded = line.is(")") && std::isfinite(parameter.maximum);
    if (!line.skip("]") && !line.skip(")")) line.refuse("expected ']' or ')' after the range");
}

}  // namespace

CommentText::CommentText(std::string_view line, std::size_t offset) : text_(line), begins_{{0, offset}} {}

void CommentText::append(const CommentText& line) {
    text_ += ' ';
    begins_.emplace_back(text_.size(), line.begins_.front().second);
    text_ += line.text_;
}

TextPosition CommentText::place(std::size_t at) const {
    auto line = begins_.front();
    for (const auto& each : begins_)
        if (each.first <= at) line = each;
    return {.offset = static_cast<std::uint32_t>(line.second + at - line.first)};
}

std::vector<CommentText> first_comment(std::string_view kernel) {
    std::vector<CommentText> comment;
    for (std::size_t line = 0; line < kernel.size() && comment.empty(); line = next_line(kernel, line)) {
        append_comments(kernel, line, comment);
        const std::string_view text = trimmed(kernel.substr(line, next_line(kernel, line) - line));
        if (!text.empty() && text != "\n" && !text.starts_with("//")) break;
    }
    return comment;
}

std::optional<CommentText> comment_behind(std::string_view kernel, std::size_t declared) {
    const std::size_t end = std::min(kernel.find('\n', declared), kernel.size());
    const std::size_t begin = kernel.find("//", declared);
    if (begin >= end || kernel.substr(begin, 3) != "///") return std::nullopt;
    CommentText comment = comment_line(kernel, begin);
    std::vector<CommentText> lines;
    append_comments(kernel, end + 1, lines);
    for (const CommentText& line : lines) comment.append(line);
    return comment;
}

void read_documentation(const std::vector<CommentText>& lines, ModelDeclaration& model) {
    std::optional<CommentText> part;
    const auto end_part = [&] {
        if (part) read_part(*part, model);
        part.reset();
    };
    for (const CommentText& line : lines) {
        const bool begins = !keyword_of(line.text()).empty();
        if (begins || line.text().empty()) end_part();
        if (line.text().empty()) continue;
        if (part)
            part->append(line);
        else
            part = line;
        // A title is one line; an equation ends with its $$.
        if (line.text().starts_with("# ") || (line.text().ends_with("$$") && line.text() != "$$")) end_part();
    }
    end_part();
}

ParameterDeclaration read_parameter(const Variable& member, const std::optional<CommentText>& comment) {
    ParameterDeclaration parameter{.name = member.name, .place = member.place};
    const std::optional<ParamType> usual = usual_type(member.type.type.kind);
    if (!usual)
        throw Refusal{
            member.type.place,
            fmt::format("a parameter is a float, int, vec3, mat3 or Table, not a {}", member.type.name)};
    parameter.type = *usual;
    if (!comment) {
        parameter.is_required = true;
        parameter.meaning = "of the kernel";
        return parameter;
    }
    CommentReader line(*comment);
    for (const auto& [word, type] : k_type_words) {
        if (!line.skip_word(word)) continue;
        if (!fits(type, member.type.type.kind))
            throw Refusal{comment->place(), fmt::format("the parameter '{}' is a {}, which cannot hold a {}",
                                                        member.name, member.type.name, word)};
        parameter.type = type;
        break;
    }
    const bool has_default = line.skip("=");
    if (has_default) read_default(line, parameter);
    parameter.is_required = !has_default && parameter.type != ParamType::matrix;
    if (parameter.type == ParamType::matrix && !has_default) parameter.numbers = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    if (line.skip_word("in")) parameter.unit = line.word();
    read_range(line, parameter);
    if (!line.skip(":")) {
        line.refuse(fmt::format(
            "expected {}':' and the meaning of '{}'",
            has_default ? "'in' and a unit, a range such as [0, 1], or " : "'= ' and the default, ",
            member.name));
    }
    parameter.meaning = line.rest();
    if (parameter.meaning.empty())
        throw Refusal{comment->place(),
                      fmt::format("the comment of '{}' does not say what it means", member.name)};
    return parameter;
}

}  // namespace candela::kernel_language
