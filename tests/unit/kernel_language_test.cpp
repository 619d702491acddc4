// The kernel language: what it accepts, what it refuses and where, and what is compiled of it.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "candela/kernel_language/language.h"
#include "candela/kernel_language/lexer.h"
#include "support/command.h"
#include "support/text.h"

namespace fs = std::filesystem;
namespace kl = candela::kernel_language;

namespace {

constexpr const char* k_kernel =
    "struct XMaterial { vec3 kd; float k; int n; Table ramp; mat3 m; };\n"
    "KERNEL Reflected x_reflect(XMaterial m, Surface s, vec3 to_light) { return Reflected(vec3(0.0f), "
    "vec3(0.0f)); }\n";

/// "", or "line:column: problem".
std::string problem_in(const std::string& body) {
    try {
        const kl::Kernel kernel =
            kl::read_kernel({"x.kernel", k_kernel}, kl::Body{"x_reflect", {"answer", body}});
        static_cast<void>(kl::emitted(kernel, kl::Emission::guarded_cpp));
        return "";
    } catch (const kl::Problem& problem) {
        return problem.text();
    }
}

std::string problem_in_kernel(const std::string& text) {
    try {
        static_cast<void>(kl::read_kernel({"x.kernel", text}));
        return "";
    } catch (const kl::Problem& problem) {
        return problem.text();
    }
}

std::string plain(const std::string& text) {
    return kl::emitted(kl::read_kernel({"x.kernel", text}), kl::Emission::kernel);
}

std::string guarded_body(const std::string& body) {
    return kl::emitted(kl::read_kernel({"x.kernel", k_kernel}, kl::Body{"x_reflect", {"answer", body}}),
                       kl::Emission::guarded_cpp);
}

constexpr const char* k_return = "\nreturn Reflected(s.color, s.color);";

struct Refused {
    const char* text;
    const char* message;
};

/// Each before a return, whose own line does not count.
void check_refused(const std::vector<Refused>& all) {
    for (const Refused& each : all) {
        const std::string problem = problem_in(each.text + std::string(k_return));
        INFO(each.text << "\n" << problem);
        CHECK(holds(problem, each.message));
        CHECK(problem.starts_with("answer:"));
    }
}

/// Removes what an author may write in several ways: blanks, comments, parentheses, the f of a literal.
std::string essence(const std::string& text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text.compare(i, 2, "//") == 0) i = std::min(text.find('\n', i), text.size() - 1);
        if (std::string_view(" \n\r\t()").find(text[i]) == std::string_view::npos) result += text[i];
    }
    return result;
}

/// All self-contained kernels of the project.
std::vector<fs::path> kernels() {
    std::vector<fs::path> files;
    for (const char* const folder :
         {"plugins", "docs/examples/plugins", "tests/packaging", "tests/targets/kernels", "sdk/templates"}) {
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(CANDELA_TEST_SOURCE) / folder))
            if (entry.path().extension() == ".kernel" && entry.path().filename() != "only_cpp.kernel")
                files.push_back(entry.path());
    }
    return files;
}

std::string kernel_text(const fs::path& file) {
    std::string text = read_file(file);
    for (const auto& [from, to] :
         {std::pair<std::string, std::string>{"@IDENT@", "new_model"}, {"@TYPE@", "NewModel"}}) {
        for (std::size_t at; (at = text.find(from)) != std::string::npos;) text.replace(at, from.size(), to);
    }
    return text;
}

}  // namespace

TEST_CASE("kernel language: every shipped kernel and every template is valid, and is emitted unchanged") {
    const std::vector<fs::path> files = kernels();
    CHECK(files.size() > 40);
    for (const fs::path& file : files) {
        INFO(file.string());
        const std::string text = kernel_text(file);
        CHECK(problem_in_kernel(text).empty());
        if (!problem_in_kernel(text).empty()) continue;
        const std::string once = plain(text);
        CHECK(essence(once) == essence(text));
        CHECK(plain(once) == once);
        CHECK(std::ranges::count(once, '\n') <= std::ranges::count(text, '\n') + 1);
    }
}

TEST_CASE(
    "kernel language: the kernel of textures is valid, with the declarations that programs put before it") {
    const std::string before =
        "struct ColorTexture { int wrap_u; int wrap_v; };\n"
        "KERNEL int color_texture_width(ColorTexture t, int level) { return level; }\n"
        "KERNEL int color_texture_height(ColorTexture t, int level) { return level; }\n"
        "KERNEL int color_texture_levels(ColorTexture t) { return 1; }\n"
        "KERNEL vec3 color_texture_texel(ColorTexture t, int level, int x, int y) { return vec3(0.0f); }\n";
    CHECK(problem_in_kernel(before + read_file(fs::path(CANDELA_TEST_SOURCE) /
                                               "sdk/target/templates/texture.kernel")) == "");
}

TEST_CASE("kernel language: pointers, references and casts are refused at their place") {
    check_refused({
        {"vec3 *p = (vec3 * const) 16; vec3 x = *p;", "answer:1:6: the kernel language has neither pointers"},
        {"uint64_t a = (uint64_t) &s;", "answer:1:25: the kernel language has neither pointers"},
        {"Surface &t = s;", "answer:1:9: the kernel language has neither pointers"},
        {"Surface && t = s;", "neither pointers nor references"},
        {"float x = *s.color;", "answer:1:11: the kernel language has neither pointers"},
        {"*(m.kd) = s.color;", "answer:1:1: the kernel language has neither pointers"},
        {"vec3 * p;", "neither pointers nor references"},
        {"const float * p = 0;", "neither pointers nor references"},
        {"float x = 1.0; x * p;", "neither pointers nor references"},
        {"float x = (float) 1;", "'float' is a type; convert a value with float(x)"},
        {"float x = (vec3) 1.0;", "convert types with float(x) or int(x)"},
        {"int x = 0; float y = 1.0 * *x;", "neither pointers nor references"},
        {"float x = s->color.x;", "no '->'"},
        {"float x = reinterpret_cast<float>(1);", "no 'reinterpret_cast'; convert with float(x) or int(x)"},
        {"float (*f)(float) = sin;", "expected a name for the variable before '('"},
        {"float x = sin;", "'sin' is a function; call it with arguments in ()"},
        {"auto x = s;", "no 'auto'"},
        {"decltype(s) x = s;", "no 'decltype'"},
        {"typeof(s) x = s;", "no 'typeof'"},
        {"int x = sizeof(int);", "no 'sizeof'"},
        {"int x = alignof(int);", "no 'alignof'"},
    });
}

TEST_CASE("kernel language: other features of C++ are refused") {
    check_refused({
        {"#include \"/etc/passwd\"", "no preprocessor"},
        {"%:include </etc/passwd>", "no preprocessor"},
        {"?"
         "?=include </etc/passwd>",
         "no preprocessor"},
        {"float x = 1.0; \\\n", "no '\\'"},
        {"// a comment that goes on \\\nfloat x = 1.0;",
         "answer:1:27: a line of a comment must not end with '\\'"},
        {"// a comment that goes on \\  \r\nfloat x = 1.0;", "a line of a comment must not end with '\\'"},
        {"// a comment that goes on ?"
         "?/\nfloat x = 1.0;",
         "a line of a comment must not end"},
        {"/* a comment *\\\n/ float x = 1.0; /* and another */",
         "answer:1:15: a line of a comment must not end"},
        {"// a comment \r float x = 1.0;", "answer:1:14: a line ends with"},
        {"float x = 1.0; \r float y = 1.0;", "a line ends with"},
        {"float x = 1.0;\v", "no '\\u{b}'"},
        {"/* a comment", "this comment is not closed"},
        {"float \xd0\xb0 = 1.0;", "answer:1:7: the kernel language has no '\xd0\xb0'"},
        {"float \\u0061 = 1.0;", "no '\\'"},
        {"float x\x01 = 1.0;", "no '\\u{1}'"},
        {"float f = [](float x) { return x; }(1.0);", "neither arrays nor attributes"},
        {"[[gnu::noreturn]] int x = 0;", "neither arrays nor attributes"},
        {"<: :> int x = 0;", "neither arrays nor attributes"},
        {"float a[1000000000];", "neither arrays nor attributes"},
        {"float x = s.color[0];", "a vector's components are v.x, v.y, v.z"},
        {"vec3 x = m.m[3];", "the columns of a matrix are m[0], m[1] and m[2]"},
        {"vec3 x = m.m[-1];", "the columns of a matrix are m[0], m[1] and m[2]"},
        {"vec3 x = m.m[m.n];", "the columns of a matrix are m[0], m[1] and m[2]"},
        {"goto x;", "no 'goto'"},
        {"x: float y = 1.0;", "no labels"},
        {"float x = 1.0, y = (x, 2.0);", "no operator ','"},
        {"x = 1.0, m.k = 2.0;", "no operator ','"},
        {"std::exit(0);", "no '::'"},
        {"::exit(0);", "no '::'"},
        {"exit(0);", "a call alone has no effect"},
        {"float x = exit(0);", "unknown function 'exit'"},
        {"float x = printf(1.0);", "unknown function 'printf'"},
        {"float x = __builtin_trap();", "reserved name"},
        {"float x = _Float16(1.0);", "reserved name"},
        {"float candela_quotient = 1.0;", "reserved name"},
        {"KERNEL float x = 1.0;", "reserved name"},
        {"CANDELA_KERNEL_INLINE float x = 1.0;", "reserved name"},
        {"float x = errno;", "reserved name"},
        {"float defined = 1.0;", "reserved name"},
        {"template <int n> int f();", "no 'template'"},
        {"min<float>(1.0, 2.0);", "expected an assignment"},
        {"float x = min<float>(1.0, 2.0);", "'float' is a type"},
        {"struct A {};", "no 'struct'"},
        {"union { float a; int b; } x;", "no 'union'"},
        {"static int x = 0;", "no 'static'"},
        {"extern int x;", "no 'extern'"},
        {"thread_local int x = 0;", "no 'thread_local'"},
        {"volatile int x = 0;", "no 'volatile'"},
        {"unsigned int x = 0;", "no 'unsigned'"},
        {"float x = new float;", "no 'new'"},
        {"delete x;", "no 'delete'"},
        {"float operator = 1.0;", "no 'operator'"},
        {"throw 1;", "no 'throw'"},
        {"asm volatile(1);", "no 'asm'"},
        {"__asm__(\"syscall\");", "no strings"},
        {"_Pragma(\"GCC poison pow\")", "no strings"},
        {"int x = 'a';", "no strings"},
        {"float x = fopen(\"/etc/passwd\", \"r\");",
         "answer:1:11: unknown function 'fopen', and the kernel language has no strings"},
        {"float x = f(dot(s.color, s.color), \"r\");", "answer:1:11: unknown function 'f', and"},
        {"float x = dot(s.color, \"r\");", "answer:1:24: the kernel language has no strings"},
        {"\xef\xbb\xbf float x = 1.0;", "answer:1:1: the text begins with a byte order mark"},
        {"float bitand = 1.0;", "no 'bitand'"},
        {"bool x = true and false;", "no 'and'; write &&"},
        {"int x = 1 | 2;", "no '|'"},
        {"int x = 1 << 2;", "no '<<'"},
        {"int x = ~1;", "no '~'"},
        {"vec3 x = {1.0, 2.0, 3.0};", "expected a value before '{'"},
        {"vec3 x{1.0};", "expected '=' and a value before '{'"},
        {"vec3 x(1.0);", "expected '=' and a value before '('"},
        {"float x = 1.0_km;", "not a number"},
        {"float x = 1.0km;", "not a number"},
        {"int x = 0x7f;", "not a number"},
        {"int x = 1'000;", "not a number"},
        {"int x = 010;", "octal"},
        {"int x = 2147483648;", "at most 2147483647"},
        {"float x = 1.0e39;", "at most 3.4e38"},
        {"double x = 1.0;", "no 'double'; numbers with a fraction are float"},
        {"try { } catch (int x) { }", "no 'try'"},
        {"using x = float;", "no 'using'"},
        {"typedef float x;", "no 'typedef'"},
        {"float f(float x) { return x; }", "expected '=' and a value before '('"},
        {"}\nKERNEL float f() { return 1.0;", "answer:1:1: this '}' has no opening '{'"},
        {"{", "answer:1:1: this '{' is not closed"},
        {"float x = (1.0;", "expected an operator or ')' before ';'"},
        {"else { }", "this 'else' has no 'if'"},
        {"switch (1) { }", "no 'switch'"},
    });
}

TEST_CASE(
    "kernel language: only existing types, names and arguments are accepted, and the nearest is suggested") {
    check_refused({
        {"float x = s.normal;", "answer:1:13: 'x' is float, but this is vec3"},
        {"vec3 x = 1.0;", "vec3(x) has it in all components"},
        {"int x = 1.5;", "int(x) drops the fraction"},
        {"if (1) { }", "compare it, as in x != 0"},
        {"vec3 x = s.nromal;", "Surface has no member 'nromal'; did you mean 'normal'?"},
        {"vec3 x = s.foo;", "it has normal, to_observer, tangent, color, position, uv"},
        {"vec3 x = to_lihgt;", "unknown variable 'to_lihgt'; did you mean 'to_light'?"},
        {"float x = dto(s.normal, to_light);", "unknown function 'dto'; did you mean 'dot'?"},
        {"vecc3 x = s.normal;", "unknown type 'vecc3'; did you mean 'vec3'?"},
        {"uint x = 1;", "unknown type 'uint'; did you mean 'int'?"},
        {"float x = dot(s.normal, 1.0);",
         "there is no dot(vec3, float); there is dot(vec2, vec2), dot(vec3, vec3)"},
        {"float x = table_at(s.normal, 1);", "there is table_at(Table, int)"},
        {"float x = fresnel_schlick(1.0);", "there is fresnel_schlick(float, float)"},
        {"Reflected r = Reflected(s.color);", "there is Reflected(vec3, vec3)"},
        {"vec3 x = s.color.rgb;", "vec3 has no 'rgb'; its components are x, y, z, even for colours"},
        {"float x = s.uv.z;", "vec2 has no 'z'; its components are x, y"},
        {"vec2 x = s.color.xyz.xy;", "a swizzle cannot be swizzled again"},
        {"s.color.xy = s.uv;", "assigning to several components at once is not allowed"},
        {"float x = true ? 1.0 : s.color;", "both values of '?' must have the same type"},
        {"bool x = s.color == s.color;", "vectors are compared component by component"},
        {"float x = m.k % 2.0;", "the remainder of floats is mod(x, y)"},
        {"vec3 x = s.color % 2;", "the remainder of floats is mod(x, y)"},
        {"bool x = !1.0;", "'!' is for bool"},
        {"mat3 x = -m.m;", "'-' is for numbers and vectors"},
        {"vec3 v = s.color; v *= m.m;", "'*=' does not take vec3 and mat3"},
        {"mat3 a = m.m; a *= 2.0;", "'*=' is not for a mat3"},
        {"bool x = 0.0 < 1.0 < 2.0;", "'<' does not take bool and float"},
        {"float x = x;", "'x' is read in its own declaration"},
        {"float x = 1.0; float x = 2.0;", "'x' is declared already"},
        {"float vec3 = 1.0;", "'vec3' is the name of a type"},
        {"float Surface = 1.0;", "'Surface' is the name of a type"},
        {"float dot = 1.0; float x = dot(s.color, s.color);",
         "'dot' is a variable here and cannot be called"},
        {"float dot = dot(s.color, s.color);", "'dot' is a variable here"},
        {"const float x = 1.0; x = 2.0;", "'x' is a constant and cannot be assigned to"},
        {"const float x;", "expected '=' and the constant's value before ';'"},
        {"y = 1.0;", "unknown variable 'y'"},
        {"return s.color;", "x_reflect() returns Reflected, but this is vec3"},
        {"break;", "this 'break' is not in a loop"},
        {"++s.color;", "'++' is for numbers, but this is a vec3"},
        {"int i = 0; int j = i++;", "'++' is a statement of its own"},
        {"float a = 1.0; if (a = 2.0) { }", "compare numbers with =="},
        {"Reflected r = x_reflect(m, s, to_light);", "x_reflect() calls itself"},
    });
}

TEST_CASE(
    "kernel language: what C++ or GLSL reserves is refused as a name, in all places where one is declared") {
    for (const std::string name : {"active",
                                   "attribute",
                                   "buffer",
                                   "cast",
                                   "centroid",
                                   "coherent",
                                   "common",
                                   "discard",
                                   "external",
                                   "filter",
                                   "fixed",
                                   "flat",
                                   "half",
                                   "highp",
                                   "in",
                                   "inout",
                                   "input",
                                   "interface",
                                   "invariant",
                                   "layout",
                                   "lowp",
                                   "mediump",
                                   "noinline",
                                   "out",
                                   "output",
                                   "packed",
                                   "partition",
                                   "patch",
                                   "precise",
                                   "precision",
                                   "resource",
                                   "row_major",
                                   "sample",
                                   "shared",
                                   "smooth",
                                   "superp",
                                   "uint",
                                   "uniform",
                                   "varying",
                                   "readonly",
                                   "noperspective",
                                   "subroutine",
                                   "mat2",
                                   "mat4",
                                   "mat2x3",
                                   "dmat3",
                                   "ivec2",
                                   "bvec3",
                                   "uvec4",
                                   "fvec2",
                                   "sampler1D",
                                   "sampler2D",
                                   "samplerCubeShadow",
                                   "isampler2DArray",
                                   "usamplerBuffer",
                                   "image3D",
                                   "iimage2D",
                                   "texture2D",
                                   "sampler3DRect",
                                   "image2DMSArray"}) {
        INFO(name);
        const std::string expected =
            fmt::format("'{}' is a word of GLSL, the language of shaders; choose another name", name);
        CHECK(problem_in(fmt::format("float {} = 1.0;", name)) == "answer:1:7: " + expected);
        for (const char* const text :
             {"struct M {{ float {}; }};", "struct {} {{ float x; }};", "const int {} = 1;",
              "KERNEL int {}(int x) {{ return x; }}", "KERNEL int x(int {}) {{ return 1; }}"})
            CHECK(holds(problem_in_kernel(fmt::format(fmt::runtime(text), name)), expected));
    }
    for (const char* const name :
         {"double", "class", "gl_x", "GL_ES", "webgl_x", "a__b", "_x", "M_PI", "NAN", "INFINITY", "std"}) {
        INFO(name);
        CHECK(problem_in(fmt::format("float {} = 1.0;", name)).starts_with("answer:1:7: "));
    }
    // GLSL ES does not let a declaration outside functions replace one of its functions; a variable may.
    for (const char* const text :
         {"struct {} {{ float x; }};", "const int {} = 1;", "KERNEL int {}(int x) {{ return x; }}"})
        CHECK(holds(problem_in_kernel(fmt::format(fmt::runtime(text), "round")),
                    "'round' is a function of GLSL"));
    CHECK(holds(problem_in_kernel("struct M { float x, length; };"),
                "x.kernel:1:21: a member cannot be called 'length'"));
    for (const char* const name : {"length", "round", "texture", "image", "sampler_2d", "mat22", "vec",
                                   "position", "color", "insides"}) {
        INFO(name);
        CHECK(problem_in(fmt::format("float {} = 1.0; return Reflected(s.color, s.color);", name)) == "");
    }
}

TEST_CASE("kernel language: an integer is converted to a real number where GLSL does so") {
    CHECK(problem_in("float x = 1; vec3 v = 2 * s.color; v *= 2; x = max(x, 0); x += 1;\n"
                     "return Reflected(v * x, vec3(0));") == "");
    const std::string text = guarded_body("float x = m.n + 1; return Reflected(vec3(m.n), vec3(0));");
    CHECK(holds(text, "float(m.n + 1)"));
    CHECK(holds(text, "vec3(float(m.n))"));
    CHECK(holds(text, "vec3(0.0f)"));
}

TEST_CASE("kernel language: no variable is read before it has a value, and every path returns one") {
    check_refused({
        {"float x; float y = x;", "answer:1:20: 'x' may be read here before it has a value"},
        {"float x; if (m.k > 0.0) x = 1.0; float y = x;", "may be read here before it has a value"},
        {"float x; x += 1.0;", "may be read here before it has a value"},
        {"float x; for (int i = 0; i < 3; ++i) x = 1.0; float y = x;", "may be read here before"},
        {"vec3 v; float x = v.x;", "may be read here before it has a value"},
    });
    CHECK(problem_in(
              "float x; if (m.k > 0.0) x = 1.0; else x = 2.0; return Reflected(vec3(x), vec3(0.0));") == "");
    CHECK(problem_in("float x; if (m.k > 0.0) return Reflected(s.color, s.color); else x = 2.0;\n"
                     "return Reflected(vec3(x), vec3(0.0));") == "");
    CHECK(problem_in("Reflected r; r.diffuse = s.color; return r;") == "");
    // An unassigned member is zero, not what was on the stack.
    CHECK(holds(guarded_body("Reflected r; r.diffuse = s.color; return r;"), "Reflected r = {};"));
    for (const char* const body : {"", "float x = 1.0;", "if (m.k > 0.0) return Reflected(s.color, s.color);",
                                   "for (int i = 0; i < 3; ++i) return Reflected(s.color, s.color);"}) {
        INFO(body);
        CHECK(holds(problem_in(body), "returns nothing"));
    }
}

TEST_CASE("kernel language: every loop ends after a known number of steps") {
    const std::string after = k_return;
    for (const char* const loop :
         {"for (int i = 0; i < 8; ++i) { }", "for (int i = 8; i > 0; i--) { }",
          "for (int i = 0; i <= 8; i += 2) { }", "const int n = 4; for (int i = 0; i < 2 * n; i++) { }",
          "for (int i = 0; i < min(m.n, 16); ++i) { }",
          "for (int i = 0; i < 8; ++i) { if (i == 3) continue; if (i > 5) break; }",
          "for (int i = 0; i < 8; ++i) for (int j = 0; j < 8; ++j) { float x = float(i * j); }"}) {
        INFO(loop);
        CHECK(problem_in(loop + after) == "");
    }
    check_refused({
        {"while (true) { }", "no 'while'; a loop needs a constant bound"},
        {"do { } while (true);", "no 'do'; a loop needs a constant bound"},
        {"for (;;) { }", "a loop's variable"},
        {"for (float x = 0.0; x < 1.0; x += 0.1) { }", "a loop's variable"},
        {"int i = 0; for (i = 0; i < 3; ++i) { }", "a loop's variable"},
        {"for (int i = 0; i < m.n; ++i) { }", "answer:1:23: a loop needs a constant bound"},
        {"for (int i = 0; true; ++i) { }", "a loop needs a constant bound"},
        {"for (int i = 0; i < 8; i *= 2) { }", "a loop's step must be"},
        {"for (int i = 0; i < 8; i += 0) { }", "a loop's step must be"},
        {"for (int i = 0; i < 8; --i) { }", "does not end"},
        {"for (int i = 0; i < 8; ++i) { i = 0; }", "'i' is a loop's counter"},
        {"for (int i = 0; i < 8; ++i) { --i; }", "'i' is a loop's counter"},
        {"int j = 0; for (int i = 0; i < 8; ++j) { }", "must change its variable 'i'"},
        {"for (int i = m.n; i < 8; ++i) { }", "must begin at a constant"},
        {"for (int i = 0; i < 8; ++i) { float i = 1.0; }", "'i' is declared already"},
        {"for (int i = 0; i < 1000000000; ++i) { }", "at most 100000 are allowed"},
        {"for (int i = 2147483000; i <= 2147483647; ++i) { }", "a loop's bound must be between"},
        {"for (int i = 0; i < 1000; ++i) for (int j = 0; j < 1000; ++j) { }", "in loops that run 1000 times"},
        {"for (int i = 0; i < 100000; ++i) { float x = dot(s.color, s.color) * dot(s.color, s.color); }",
         "more than 1000000 steps"},
    });
}

TEST_CASE("kernel language: functions that call one another repeatedly are bounded as well") {
    std::string text = "KERNEL float f0(float x) { return x * x; }\n";
    for (int i = 1; i < 40; ++i) {
        const std::string before = "f" + std::to_string(i - 1);
        text += "KERNEL float f" + std::to_string(i) + "(float x) { return " + before + "(x) + " + before +
                "(x); }\n";
    }
    CHECK(holds(problem_in_kernel(text), "is too large"));
    // The size of stored values is bounded as well.
    std::string structs = "struct S0 { mat3 a, b; };\n";
    for (int i = 1; i < 40; ++i)
        structs += "struct S" + std::to_string(i) + " { S" + std::to_string(i - 1) + " a, b; };\n";
    CHECK(holds(problem_in_kernel(structs), "x.kernel:7:19: struct S6 holds more than 1000 numbers"));
    std::string locals = "struct S { mat3 a, b, c, d; };\nKERNEL float f(S s) {\n";
    for (int i = 0; i < 1000; ++i) locals += "S s" + std::to_string(i) + " = s;\n";
    CHECK(holds(problem_in_kernel(locals + "return 1.0f; }"), "it may compute 30000 numbers"));
    CHECK(holds(problem_in_kernel(
                    "KERNEL float f(float x) { return g(x); }\nKERNEL float g(float x) { return f(x); }"),
                "g() is declared further down; move it before f()"));
    CHECK(holds(problem_in_kernel("KERNEL float f(float x) { return f(x); }"), "f() calls itself"));
}

TEST_CASE("kernel language: a kernel declares structs, constants and functions, each name once") {
    CHECK(problem_in_kernel("const float X_PI = 3.14159265f;\nconst vec3 X_UP = vec3(0.0f, 1.0f, 0.0f);\n"
                            "KERNEL vec3 f(float a) { return X_PI * a * X_UP; }") == "");
    for (const Refused& each : std::vector<Refused>{
             {"float x = 1.0;", "x.kernel:1:1: expected a struct, a constant (const) or a function (KERNEL)"},
             {"const float x = sin(1.0);", "consist only of numbers"},
             {"const float x = y;", "unknown variable"},
             {"struct Surface { float x; };", "'Surface' is the name of a type"},
             {"struct A { A a; };", "unknown type 'A'"},
             {"struct A { float x; float x; };", "'x' is a member already"},
             {"struct A { };", "no members"},
             {"struct A { float x; }", "expected ';' before the end"},
             {"struct A { float *x; };", "neither pointers nor references"},
             {"struct A { float x[3]; };", "neither arrays"},
             {"struct A : B { float x; };", "expected '{' before ':'"},
             {"KERNEL float dot(float x) { return x; }", "'dot' is a function already"},
             {"KERNEL float fresnel_schlick(float x) { return x; }", "is a function already"},
             {"KERNEL float f(float x) { return x; }\nKERNEL float f(float x) { return x; }",
              "x.kernel:2:14: 'f' is a function already"},
             {"KERNEL float f(float &x) { return x; }", "neither pointers nor references"},
             {"KERNEL float f(out float x) { return x; }", "'in', 'out' and 'inout' do not exist"},
             {"KERNEL float f(float x, float x) { return x; }", "'x' is declared already"},
             {"KERNEL float f(float x = 1.0) { return x; }", "expected ',' or ')' before '='"},
             {"KERNEL void f(float x) { }", "no 'void'; every function returns a value"},
             {"KERNEL float f(float x);", "expected '{' before ';'"},
             {"#define X 1", "no preprocessor"},
             {"namespace a { }", "no 'namespace'"},
             {"KERNEL float f(float x) { return x; } }", "has no opening '{'"},
         }) {
        INFO(each.text);
        const std::string problem = problem_in_kernel(each.text);
        INFO(problem);
        CHECK(holds(problem, each.message));
    }
}

TEST_CASE("kernel language: texts that are too long, too deep or have too many words are refused at once") {
    const std::string many(400'000, '(');
    CHECK(holds(problem_in(many), "20000 are allowed"));
    CHECK(holds(problem_in_kernel(many), "200000 are allowed"));
    std::string words;
    for (int i = 0; i < 60'000; ++i) words += "a ";
    CHECK(holds(problem_in_kernel(words), "more than 50000 words"));
    const auto repeated = [](const std::string& part, int count) {
        std::string text;
        for (int i = 0; i < count; ++i) text += part;
        return text;
    };
    const std::vector<std::pair<std::string, const char*>> texts = {
        {"float x = " + repeated("(", 5000), "nested more than 64 deep"},
        {"float x = " + repeated("- ", 5000) + "1.0;", "nested more than 64 deep"},
        {"bool x = " + repeated("!", 5000) + "true;", "nested more than 64 deep"},
        {"float x = " + repeated("sin(", 3000), "nested more than 64 deep"},
        {"float x = " + repeated("true ? 1.0 : ", 1000) + "1.0;", "nested more than 64 deep"},
        {"float x = 1.0" + repeated(" + 1.0", 2000) + ";", "operations depend on one another"},
        {"float x = s" + repeated(".a", 5000) + ";", "operations depend on one another"},
        {"s" + repeated(".a", 5000) + " = 1.0;", "not nested this deeply"},
        {repeated("{", 5000), "nested more than 64 deep"},
        {repeated("if (true) ", 1000) + ";", "nested more than 64 deep"},
        {repeated("if (true) ; else ", 1000) + ";", "nested more than 64 deep"},
        {repeated("for (int i = 0; i < 1; ++i) ", 500) + ";", "nested more than 64 deep"},
        {"float " + repeated("a", 1000) + " = 1.0;", "at most 100 characters"},
        {"float x = 1." + repeated("0", 1000) + ";", "at most 100 characters"},
    };
    for (const auto& [text, message] : texts) {
        INFO(text.substr(0, 40));
        const std::string problem = problem_in(text);
        INFO(problem);
        CHECK(holds(problem, message));
    }
}

TEST_CASE("kernel language: only names and numbers of the author's text are compiled, each in its line") {
    const std::string text = guarded_body(
        "// a comment\n\n  float x = .5 + 1. + 2.e1; /* another */ float y = x\n    * 2.0;\n"
        "return Reflected(vec3(y), vec3(s.uv.yx, 1.0));");
    INFO(text);
    CHECK(!holds(text, "comment"));
    CHECK(holds(text, "#line 1 \"answer\"\n\n\n  float x = 0.5f + 1.0f + 2.0e1f;"));
    CHECK(holds(text, "\n    * 2.0f;\nreturn"));
    CHECK(holds(text, "vec3(vec2(s.uv.yx), 1.0f)"));
    CHECK(holds(text, "#line 2 \"x.kernel\"\n"));
    // Names that a header might define as macros.
    CHECK(holds(text, "#ifdef to_light\n#error"));
}

TEST_CASE("kernel language: integer operations that C++ leaves undefined are defined") {
    const std::string text = guarded_body(
        "int a = m.n / m.n; int b = m.n % m.n; int c = m.n / 2; int d = int(m.k); a /= m.n; a %= 3;\n"
        "return Reflected(vec3(a), vec3(b + c + d));");
    INFO(text);
    CHECK(holds(text, "int a = candela_quotient(m.n, m.n);"));
    CHECK(holds(text, "int b = candela_remainder(m.n, m.n);"));
    CHECK(holds(text, "int c = m.n / 2;"));
    CHECK(holds(text, "int d = candela_whole(m.k);"));
    CHECK(holds(text, "a = candela_quotient(a, m.n);"));
    CHECK(holds(text, "a %= 3;"));
    // Programs are generated from the kernel language itself.
    CHECK(!holds(plain("KERNEL int f(int a) { return a / a; }"), "candela_"));
}

TEST_CASE("lexer: the lexemes of any text are the text, and comments can be left out") {
    const std::string text =
        "#define A(x) \\\n x\nvec3 r=2.5e-3f*n[0]; /* a\n*/h<<=.5; // b\n if(a<=b&&!c)\xff\t\"d\" /* open";
    std::string joined, code;
    for (const kl::Lexeme& lexeme : kl::lexemes_of(text)) {
        CHECK(lexeme.offset == joined.size());
        joined += lexeme.text;
    }
    CHECK(joined == text);
    for (const kl::Lexeme& lexeme : kl::code_of("vec3 r=2.5e-3f*n[0]; /* a */h<=.5||b // c"))
        code += std::string(lexeme.text) + " ";
    CHECK(code == "vec3 r = 2.5e-3f * n [ 0 ] ; h <= .5 || b ");
    CHECK(kl::without_comments("a/* b */c // d\ne") == "a c \ne");
}
