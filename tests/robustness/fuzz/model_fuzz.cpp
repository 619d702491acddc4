// Untrusted comments that declare a model: none adds code to the plugin that is compiled.
// compiled.
#include <algorithm>
#include <string>
#include <string_view>

#include "candela/kernel_language/language.h"
#include "candela/kernel_language/model.h"
#include "robustness/fuzz/fuzz.h"

namespace kl = candela::kernel_language;

namespace {

constexpr const char* k_functions =
    "KERNEL vec3 x_reflect_ambient(XMaterial m, Surface s) { return s.color * m.a; }\n"
    "KERNEL Reflected x_reflect(XMaterial m, Surface s, vec3 to_light) { return Reflected(m.b, s.color); }\n";

/// The source without its string literals, which are checked on the way.
std::string without_literals(const std::string& source) {
    std::string rest;
    for (std::size_t i = 0; i < source.size(); ++i) {
        if (source[i] != '"') {
            rest += source[i];
            continue;
        }
        for (++i; i < source.size() && source[i] != '"'; ++i) {
            fuzz::require(source[i] != '\n',
                          "a string literal of the plugin's source goes over the end of its line");
            fuzz::require(static_cast<unsigned char>(source[i]) >= 0x20,
                          "a control character is in a string literal");
            if (source[i] == '\\') ++i;
        }
        fuzz::require(i < source.size(), "a string literal of the plugin's source does not end");
    }
    return rest;
}

/// Outside of string literals, comments can only choose between the words of a declaration, and write
/// numbers.
void check(const std::string& source) {
    const std::string code = without_literals(source);
    constexpr std::string_view k_signs = "_ \n{}[]().,;:<>=&|#/-+*";
    for (const char c : code) {
        const bool is_word = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        fuzz::require(is_word || k_signs.find(c) != std::string_view::npos,
                      "a sign of a comment is in the plugin's code");
    }
    for (const char* const word : {"asm", "system", "extern", "reinterpret_cast", "#define"})
        fuzz::require(code.find(word) == std::string::npos, "a word of a comment is in the plugin's code");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    // Lines before the first that begins with '~' describe the model, the others its parameters.
    std::string head, members;
    std::string_view rest = fuzz::text_of(data, size);
    const char* const names[] = {"    float a;", "    vec3 b;", "    int c;", "    Table t;", "    mat3 r;"};
    std::size_t member = 0;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        std::string line(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
        if (line.starts_with('~') && member < std::size(names)) {
            members += std::string(names[member++]) + " ///" + line.substr(1) + "\n";
        } else if (member == 0) {
            head += "///" + line + "\n";
        } else {
            members += "    ///" + line + "\n";
        }
    }
    for (; member < std::size(names); ++member) members += std::string(names[member]) + "\n";
    const std::string text = head + "struct XMaterial {\n" + members + "};\n" + k_functions;
    try {
        const kl::ModelDeclaration model = kl::read_model(kl::read_kernel({"x.kernel", text}), "x");
        for (const std::string& equation : model.formula)
            fuzz::require(kl::plain_text(equation).size() <= 40 * equation.size() + 40,
                          "an equation grows without bound");
        check(kl::plugin_source(model, "x.kernel"));
    } catch (const kl::Problem& problem) {
        const auto lines = static_cast<std::size_t>(std::ranges::count(text, '\n'));
        fuzz::require(problem.line() >= 1 && problem.line() <= lines + 1,
                      "a problem is not on a line of the text");
        fuzz::require(problem.column() >= 1, "a problem is left of its line");
    }
    return 0;
}
