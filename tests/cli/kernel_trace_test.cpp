// Kernel text with notes, compiled and run: compares all forms of statement with values computed by hand.
#include "inspect/kernel_trace.h"

#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "support/command.h"

namespace fs = std::filesystem;

namespace {

/// The notes of a program, as "name member values" and, for a function, "name()", indented by depth.
std::vector<std::string> notes_of(const std::string& kernel, const std::string& call) {
    TracedKernels kernels;
    const std::string traced = kernels.traced(kernel, "any.kernel");
    const fs::path folder = scratch_directory();
    const fs::path source = folder / "traced.cpp";
    write_file(source, std::string(kernel_trace_prelude()) +
                           "#include \"candela/kernel/kernel.h\"\nnamespace candela::kernel {\n" + traced +
                           "\n}\nusing namespace candela::kernel;\nint main() { " + call + "; }\n");
    const fs::path program = folder / "traced";
    const CommandResult compiled = run_program({CANDELA_TEST_COMPILER, "-std=c++20", "-w", "-I",
                                                std::string(CANDELA_TEST_SOURCE) + "/core/include",
                                                source.string(), "-o", program.string()});
    INFO(traced);
    INFO(compiled.err);
    REQUIRE(compiled.exit_code == 0);
    std::istringstream lines(run_program({program.string()}).out);
    std::vector<std::string> notes;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string kind, member, values;
        std::size_t number = 0;
        int depth = 0;
        words >> kind >> number >> depth >> member;
        std::getline(words, values);
        const std::string name = kernels.steps.at(number).name;
        if (kind == "enter") {
            notes.push_back(std::string(static_cast<std::size_t>(depth), ' ') + name + "()");
        } else {
            notes.push_back(std::string(static_cast<std::size_t>(depth - 1), ' ') + name +
                            (member == "." ? "" : member) + values);
        }
    }
    return notes;
}

using Notes = std::vector<std::string>;

}  // namespace

TEST_CASE("declarations, assignments and results are noted, even several in one statement") {
    CHECK(notes_of("KERNEL float any_f(float x) {\n"
                   "    float a = x + 1.0f, b = max(x, 5.0f);  // b = 9, as comments say\n"
                   "    float c;\n    c = a * b;\n    c += 2.0f;\n    return c;\n}\n",
                   "any_f(2.0f)") == Notes{"any_f()", "x 2", "a 3", "b 5", "c 15", "c 17", "return 17"});
}

TEST_CASE("branches and loops are noted, with and without braces") {
    CHECK(
        notes_of(
            "KERNEL float any_f(int n) {\n"
            "    float sum = 0.0f;\n"
            "    for (int i = 0; i < n; ++i) sum += float(i);\n"
            "    if (sum > 2.0f) sum = 10.0f; else sum = 20.0f;\n"
            "    if (n == 3) {\n        sum *= 0.5f;\n    } else if (n == 4) {\n        sum = 7.0f;\n    }\n"
            "    while (sum > 4.0f) sum -= 1.0f;\n"
            "    return sum;\n}\n",
            "any_f(3)") ==
        Notes{"any_f()", "n 3", "sum 0", "sum 0", "sum 1", "sum 3", "sum 10", "sum 5", "sum 4", "return 4"});
}

TEST_CASE("structs are noted member by member, and called functions below their caller") {
    CHECK(
        notes_of("struct AnyPair {\n    float a, b;  // two\n    vec3 c;\n};\n#define ANY_TWO \\\n    2.0f\n"
                 "KERNEL float any_twice(float x) {\n    return ANY_TWO * x;\n}\n"
                 "KERNEL AnyPair any_f(AnyPair p) {\n"
                 "    p.a = any_twice(p.b);\n    vec2 uv = vec2(p.a, p.b);\n    return p;\n}\n",
                 "AnyPair p; p.a = 1; p.b = 4; p.c = vec3(1.0f, 2.0f, 3.0f); any_f(p)") ==
        Notes{"any_f()", "p.a 1", "p.b 4", "p.c 1 2 3", " any_twice()", " x 4", " return 8", "p.a 8",
              "uv 8 4", "return.a 8", "return.b 4", "return.c 1 2 3"});
}

TEST_CASE("a step has the statement's line and text, without comments and on one line") {
    TracedKernels kernels;
    kernels.traced(
        "/* one\n   two */\nKERNEL vec3 any_f(vec3 n) {\n    vec3 r =\n        2.0f * n;\n    return r;\n}\n",
        "any.kernel");
    REQUIRE(kernels.steps.size() == 4);
    CHECK(kernels.steps[0].line == 3);
    CHECK(kernels.steps[2].line == 4);
    CHECK(kernels.steps[2].text == "vec3 r = 2.0f * n");
    CHECK(kernels.steps[3].text == "return r");
}

TEST_CASE("truncated text, or text that is not a kernel, is read to its end") {
    const std::string text =
        "struct A { float x; };\n#define B \\\n 1\nKERNEL float f(float x) { if (x > 1.0f) { x = 2.0f; } /* "
        "c */ return x; }";
    for (std::size_t length = 0; length <= text.size(); ++length) {
        TracedKernels kernels;
        const std::string traced = kernels.traced(text.substr(0, length), "a.kernel");
        CHECK(traced.size() <= 40 * (length + 1) + 1000);
    }
    for (const char* const other :
         {"}", "{", ")", "(((", ";;;", "return", "f(", "struct", "struct {", "/*", "#", "= = ="}) {
        TracedKernels kernels;
        CHECK(kernels.traced(other, "a.kernel").size() < 2000);
    }
}
