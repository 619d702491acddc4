#include "candela/kernel_language/language.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "candela/embed.h"
#include "checker.h"
#include "parser.h"
#include "prelude.h"

import candela.util;

CANDELA_EMBED(candela_kernel_language_prelude, CANDELA_KERNEL_PRELUDE);

namespace candela::kernel_language {

Problem problem_at(const Source& source, std::size_t offset, const std::string& message) {
    const std::string_view before = std::string_view(source.text).substr(0, offset);
    const std::size_t line_end = before.rfind('\n');
    const std::string_view in_line =
        line_end == std::string_view::npos ? before : before.substr(line_end + 1);
    return {source.name, 1 + static_cast<std::size_t>(std::ranges::count(before, '\n')),
            1 + character_count(in_line), message};
}

namespace {

struct Prelude {
    std::vector<Declaration> declarations;
    Declared declared;
};

const Prelude& prelude() {
    static const Prelude k_prelude = [] {
        std::vector<Declaration> declarations = parsed_kernel(tokens_of(candela_kernel_language_prelude, 0));
        Checker checker({});
        checker.check(declarations);
        return Prelude{std::move(declarations), checker.declared()};
    }();
    return k_prelude;
}

void require_size(const Source& source, std::size_t longest) {
    if (source.text.size() > longest)
        throw problem_at(
            source, 0,
            fmt::format("the text has {} bytes; at most {} are allowed", source.text.size(), longest));
}

void replace(std::vector<Declaration>& declarations, const Body& body) {
    const auto found = std::ranges::find_if(declarations, [&](const Declaration& each) {
        const auto* const function = std::get_if<Function>(&each);
        return function != nullptr && function->name == body.function;
    });
    if (found == declarations.end())
        throw std::invalid_argument(fmt::format("the kernel has no function '{}'", body.function));
    std::vector<Statement> statements = parsed_body(tokens_of(body.source.text, 1));
    if (statements.empty()) throw Refusal{{0, 1}, "the body returns nothing"};
    std::get<Function>(*found).body = std::move(statements);
}

}  // namespace

const std::vector<Declaration>& prelude_declarations() { return prelude().declarations; }

std::string Problem::text() const { return fmt::format("{}:{}:{}: {}", file_, line_, column_, what()); }

Kernel read_kernel(const Source& source, const std::optional<Body>& body) {
    require_size(source, k_longest_text);
    Kernel kernel{.sources = {source}};
    if (body) {
        require_size(body->source, k_longest_body);
        kernel.sources.push_back(body->source);
    }
    try {
        kernel.declarations = parsed_kernel(tokens_of(source.text, 0));
        if (body) replace(kernel.declarations, *body);
        Checker checker(prelude().declared);
        checker.check(kernel.declarations);
        for (const Structure& structure : checker.declared().structures)
            kernel.structures.push_back(structure.name);
    } catch (const Refusal& refusal) {
        throw problem_at(kernel.sources[refusal.place.source], refusal.place.offset, refusal.message);
    }
    return kernel;
}

}  // namespace candela::kernel_language
