// Any bytes as an answer to an exercise: what passes as the body of a function cannot leave it.
#include <algorithm>

#include "fuzz/fuzz.h"
#include "kernel_language.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text = fuzz::text_of(data, size);
    const auto problem = problem_in_body(text);
    // Without comments; this is what is compiled.
    const std::string body = body_for_cpp(text);
    const auto lines = [](std::string_view some) { return std::ranges::count(some, '\n'); };
    fuzz::require(lines(body) == lines(text), "lines stay as they are");
    if (problem) {
        fuzz::require(problem->line >= 1 && problem->line <= 1 + static_cast<std::size_t>(lines(text)),
                      "a problem is on a line of the text");
        fuzz::require(problem->column >= 1 && !problem->message.empty(), "a problem is said");
        return 0;
    }
    fuzz::require(body.find_first_of("#[]\"'\\@$`") == std::string::npos,
                  "no directive, array, attribute, text or splice");
    for (const char* const foreign :
         {"::", "->", "%:", "<:", ":>", "<%", "%>", "//", "/*", "__", "asm", "goto", "template"}) {
        const std::size_t at = body.find(foreign);
        const bool is_part_of_a_word = at != std::string::npos && foreign[0] >= 'a' && foreign[0] <= 'z';
        fuzz::require(at == std::string::npos || is_part_of_a_word, "nothing that is not in the language");
    }
    int depth = 0;
    for (const char c : body) {
        depth += c == '{' ? 1 : c == '}' ? -1 : 0;
        fuzz::require(depth >= 0, "no brace closes the function");
    }
    fuzz::require(depth == 0, "all braces are closed");
    fuzz::require(
        std::ranges::all_of(
            body, [](char c) { return (c >= ' ' && c <= '~') || c == '\n' || c == '\t' || c == '\r'; }),
        "what is compiled is ASCII");
    return 0;
}
