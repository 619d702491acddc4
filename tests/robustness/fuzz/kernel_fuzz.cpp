// Nearly valid kernels, made by a grammar, with pieces of C++ spliced in: nothing outside the language is
// accepted, and accepted text reads back as itself.
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "candela/kernel_language/language.h"
#include "kernel_text.h"
#include "robustness/fuzz/fuzz.h"

namespace kl = candela::kernel_language;

namespace {

constexpr std::array<std::string_view, 7> k_types = {"float", "int",  "bool",   "vec2",
                                                     "vec3",  "mat3", "Surface"};

constexpr std::array<std::string_view, 60> k_splices = {"*",
                                                        "&",
                                                        "&&",
                                                        "**",
                                                        "(vec3 *)",
                                                        "(float)",
                                                        "vec3 *p = ",
                                                        "Surface &t = s;",
                                                        "[[x]]",
                                                        "[",
                                                        "]",
                                                        "[0]",
                                                        "::",
                                                        "->",
                                                        "#define x",
                                                        "#",
                                                        "%:",
                                                        "<:",
                                                        "<%",
                                                        "?"
                                                        "?/\n",
                                                        "\\\n",
                                                        "//",
                                                        "/*",
                                                        "*/",
                                                        "\"",
                                                        "'",
                                                        "{",
                                                        "}",
                                                        "(",
                                                        ")",
                                                        ",",
                                                        ";",
                                                        "=",
                                                        "==",
                                                        "++",
                                                        "--",
                                                        "-",
                                                        "!",
                                                        "?",
                                                        ":",
                                                        "goto x;",
                                                        "x:",
                                                        "sizeof",
                                                        "asm(\"\")",
                                                        "template<",
                                                        "operator",
                                                        "new",
                                                        "auto",
                                                        "const",
                                                        "return",
                                                        "for (;;)",
                                                        "while (1)",
                                                        "if (true)",
                                                        "else",
                                                        "struct",
                                                        "KERNEL",
                                                        "float",
                                                        "0x10",
                                                        "1e99",
                                                        "\xc3\xa4"};

class Generator {
  public:
    explicit Generator(fuzz::Bytes& bytes) : bytes_(bytes) {}

    std::string kernel() {
        if (bytes_.flag()) put("struct M { float a; vec3 b; int c; mat3 m; Table t; };\n");
        const bool has_struct = !out_.empty();
        if (bytes_.flag()) {
            put("const float K = ");
            literal();
            put(";\n");
        }
        const unsigned functions = 1 + bytes_.at_most(2);
        for (unsigned i = 0; i < functions; ++i) {
            const std::string_view type = one_of(k_types);
            put("KERNEL ");
            put(type);
            put(" f" + std::to_string(i) + "(Surface s, float x, int n, vec3 v, mat3 a");
            if (has_struct) put(", M m");
            put(") {\n");
            statements(3);
            put("return ");
            expression(4);
            put(";\n}\n");
            function_ = "f" + std::to_string(i);
        }
        return std::move(out_);
    }

  private:
    template <std::size_t count>
    std::string_view one_of(const std::array<std::string_view, count>& all) {
        return all[bytes_.at_most(count - 1)];
    }

    /// Sometimes with something else before it, or without it.
    void put(std::string_view text) {
        const std::uint32_t chance = bytes_.empty() ? 255 : bytes_.at_most(255);
        if (chance < 3) out_ += one_of(k_splices);
        if (chance == 3) return;
        if (chance == 4) out_ += text;
        out_ += text;
    }

    void literal() {
        switch (bytes_.at_most(4)) {
            case 0:
                return put("1.5f");
            case 1:
                return put("3");
            case 2:
                return put(".5");
            case 3:
                return put("2.e1");
            default:
                return put(bytes_.flag() ? "true" : "0");
        }
    }

    void variable() {
        constexpr std::array<std::string_view, 14> k_variables = {
            "x",       "n",         "v",    "a", "v.x", "v.zyx",  "s.normal",
            "s.uv.yx", "s.color.x", "a[1]", "y", "m.a", "m.b.xy", "K"};
        put(one_of(k_variables));
    }

    void arguments(unsigned depth, unsigned count) {
        put("(");
        for (unsigned i = 0; i < count; ++i) {
            if (i > 0) put(", ");
            expression(depth);
        }
        put(")");
    }

    void expression(unsigned depth) {
        if (depth == 0 || bytes_.empty()) return bytes_.flag() ? literal() : variable();
        constexpr std::array<std::string_view, 13> k_operators = {
            "+", "-", "*", "/", "%", "<", "<=", "==", ">", "&&", "||", "!=", ">="};
        constexpr std::array<std::string_view, 10> k_ones = {"sin", "float",  "int",  "vec3", "normalize",
                                                             "abs", "length", "sqrt", "vec2", "transpose"};
        constexpr std::array<std::string_view, 6> k_twos = {"dot", "min", "max", "pow", "cross", "Reflected"};
        switch (bytes_.at_most(8)) {
            case 0:
                return literal();
            case 1:
                return variable();
            case 2:
            case 3:
                put("(");
                expression(depth - 1);
                put(") ");
                put(one_of(k_operators));
                put(" ");
                return expression(depth - 1);
            case 4:
                put(one_of(k_ones));
                return arguments(depth - 1, 1);
            case 5:
                put(one_of(k_twos));
                return arguments(depth - 1, 2);
            case 6:
                put(bytes_.flag() ? "-" : "!");
                return expression(depth - 1);
            case 7:
                expression(depth - 1);
                put(" < ");
                expression(depth - 1);
                put(" ? ");
                expression(depth - 1);
                put(" : ");
                return expression(depth - 1);
            default:
                put(function_.empty() ? "mix" : function_);
                return arguments(depth - 1, function_.empty() ? 3 : 5);
        }
    }

    void statements(unsigned depth) {
        for (unsigned left = bytes_.at_most(4); left > 0; --left) statement(depth);
    }

    void block(unsigned depth) {
        put("{\n");
        statements(depth);
        put("}\n");
    }

    void statement(unsigned depth) {
        constexpr std::array<std::string_view, 6> k_assignments = {
            " = ", " += ", " -= ", " *= ", " /= ", " %= "};
        constexpr std::array<std::string_view, 5> k_targets = {"x", "v", "v.x", "y", "n"};
        switch (bytes_.at_most(depth > 0 ? 6 : 3)) {
            case 0:
                put(one_of(k_types));
                put(" y");
                if (bytes_.flag()) {
                    put(" = ");
                    expression(2);
                }
                return put(";\n");
            case 1:
                put("x = ");
                expression(3);
                return put(";\n");
            case 2:
                put(one_of(k_targets));
                put(one_of(k_assignments));
                expression(2);
                return put(";\n");
            case 3:
                return put("++n;\n");
            case 4:
                put("if (");
                expression(2);
                put(") ");
                block(depth - 1);
                if (!bytes_.flag()) return;
                put("else ");
                return block(depth - 1);
            case 5:
                put("for (int i = 0; i < ");
                put(bytes_.flag() ? "4" : "min(n, 4)");
                put("; ++i) ");
                return block(depth - 1);
            default:
                return block(depth - 1);
        }
    }

    fuzz::Bytes& bytes_;
    std::string function_;
    std::string out_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::Bytes bytes(data, size);
    const std::string text = Generator(bytes).kernel();
    try {
        fuzz::check_accepted(kl::read_kernel({"x.kernel", text}));
    } catch (const kl::Problem& problem) {
        fuzz::check_problem(problem, text);
    }
    return 0;
}
