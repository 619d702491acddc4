// The declarations in a kernel file's comments: what they say of a model, and which of them are refused.
#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>

#include "candela/kernel_language/language.h"
#include "candela/kernel_language/model.h"

#include "support/text.h"

import candela.api;

namespace kl = candela::kernel_language;
using candela::ParamType;

namespace {

constexpr const char* k_functions =
    "KERNEL vec3 x_reflect_ambient(XMaterial m, Surface s) { return vec3(0.0f); }\n"
    "KERNEL Reflected x_reflect(XMaterial m, Surface s, vec3 to_light) { return Reflected(s.color, s.color); "
    "}\n";

kl::ModelDeclaration model_in(const std::string& text, const char* name = "x") {
    return kl::read_model(kl::read_kernel({std::string(name) + ".kernel", text}), name);
}

kl::ModelDeclaration model_with(const std::string& member, const std::string& comment = "") {
    return model_in(comment + "struct XMaterial {\n    " + member + "\n};\n" + k_functions);
}

/// "", or "file:line:column: problem".
std::string problem_with(const std::string& member, const std::string& comment = "") {
    try {
        static_cast<void>(model_with(member, comment));
        return "";
    } catch (const kl::Problem& problem) {
        return problem.text();
    }
}

kl::ParameterDeclaration parameter_in(const std::string& member) {
    return model_with(member).parameters.at(0);
}

}  // namespace

TEST_CASE("a comment above the struct describes the model") {
    const kl::ModelDeclaration model =
        model_with("vec3 kd;  /// = 0.5: the colour",
                   "/// # A title\n"
                   "/// One sentence,\n"
                   "/// on two lines.\n"
                   "///\n"
                   "/// $$ I_d = k_d C_o I_L $$\n"
                   "/// $$ H = \\frac{L + V}{\\lvert L + V \\rvert} $$\n"
                   "///\n"
                   "/// When one uses it.\n"
                   "///\n"
                   "/// reference: Author (1999), A title,\n"
                   "/// a journal\n"
                   "/// properties: isotropic, attenuation = by distance\n"
                   "/// preset: brass (Somebody, 2001): kd = 0.1 0.2 0.3, color = 1 2 3\n");
    CHECK(model.kind == candela::PluginKind::reflection);
    CHECK(model.title == "A title");
    CHECK(model.summary == "One sentence, on two lines.");
    CHECK(model.description == std::vector<std::string>{"When one uses it."});
    REQUIRE(model.formula.size() == 2);
    CHECK(kl::plain_text(model.formula[0]) == "I_d = k_d C_o I_L");
    CHECK(kl::plain_text(model.formula[1]) == "H = (L + V) / |L + V|");
    CHECK(model.reference == "Author (1999), A title, a journal");
    REQUIRE(model.properties.size() == 2);
    CHECK(model.properties[1] == std::pair<std::string, std::string>("attenuation", "by distance"));
    REQUIRE(model.presets.size() == 1);
    CHECK(model.presets[0].name == "brass");
    CHECK(model.presets[0].source == "Somebody, 2001");
    CHECK(model.presets[0].values.at(0).second == std::vector<float>{0.1f, 0.2f, 0.3f});
    CHECK(model.presets[0].color == std::vector<float>{1, 2, 3});
}

TEST_CASE("a comment behind a member declares the parameter's default, unit, range and meaning") {
    const kl::ParameterDeclaration angle =
        parameter_in("float a;  /// = 25 in deg [0, 90): how wide\n    /// it is");
    CHECK(angle.type == ParamType::real);
    CHECK(angle.numbers == std::vector<float>{25});
    CHECK(angle.unit == "deg");
    CHECK(angle.minimum == 0);
    CHECK(angle.maximum == 90);
    CHECK_FALSE(angle.minimum_excluded);
    CHECK(angle.maximum_excluded);
    CHECK(angle.meaning == "how wide it is");
    CHECK_FALSE(angle.is_required);

    CHECK(parameter_in("vec3 kd;  /// = 0.5 [0, 1]: m").numbers == std::vector<float>{0.5f, 0.5f, 0.5f});
    CHECK(parameter_in("vec3 c;  /// color = 255 0 10: m").type == ParamType::color);
    CHECK(parameter_in("vec3 p;  /// point in m: m").is_required);
    CHECK(parameter_in("int n;  /// = 3 [1, inf): m").maximum == std::numeric_limits<float>::infinity());
    CHECK(parameter_in("int b;  /// bool = true: m").type == ParamType::boolean);
    const kl::ParameterDeclaration choice = parameter_in("int f;  /// = exact | schlick: m");
    CHECK(choice.type == ParamType::choice);
    CHECK(choice.choices == std::vector<std::string>{"exact", "schlick"});
    CHECK(parameter_in("Table t;  /// numbers = 1 2 3: m").numbers.size() == 3);
    CHECK(parameter_in("mat3 m3;  /// [-1, 1]: m").numbers == std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1});
    // A formula can be tried before its parameters are declared.
    CHECK(parameter_in("float k;  // not a declaration").is_required);
}

TEST_CASE("mistakes in a declaration are reported at their place") {
    struct Case {
        const char* member;
        const char* comment;
        const char* problem;
    };
    for (const auto& [member, comment, problem] : {
             Case{"float a;  /// = x: m", "", "x.kernel:2:21: expected a number"},
             Case{"float a;  /// = 1 [0; 1]: m", "", "x.kernel:2:25: expected ',' and the upper bound"},
             Case{"float a;  /// = 1 2: m", "",
                  "x.kernel:2:20: expected 1 number as the default of 'a', got 2"},
             Case{"float a;  /// color = 1: m", "",
                  "x.kernel:2:19: the parameter 'a' is a float, which cannot hold a color"},
             Case{"float a;  /// = 1", "",
                  "x.kernel:2:22: expected 'in' and a unit, a range such as [0, 1], or ':' and "
                  "the meaning of 'a'"},
             Case{"float a;  /// = 1:", "", "x.kernel:2:19: the comment of 'a' does not say what it means"},
             Case{"vec2 a;  /// = 1: m", "",
                  "x.kernel:2:5: a parameter is a float, int, vec3, mat3 or Table, not a vec2"},
             Case{"float a;  /// = 1: m", "/// # A\n/// # B\n",
                  "x.kernel:2:5: the model has a title already"},
             Case{"float a;  /// = 1: m", "/// $$ a\n", "x.kernel:1:5: this equation has no closing $$"},
             Case{"float a;  /// = 1: m", "/// expects: a + b <= 2 or not\n",
                  "x.kernel:1:25: expected 'a <= b because …', 'a < b because …' or 'a + b <= 1 because …'"},
             Case{"float a;  /// = 1: m", "/// presets: mine\n", "x.kernel:1:14: expected classic or metals"},
         }) {
        INFO(member << " " << comment);
        CHECK(problem_with(member, comment) == problem);
    }
}

TEST_CASE("what a model reads is found in its functions, and in those that they call") {
    const kl::ModelDeclaration model = model_in(
        "KERNEL float x_helper(Surface s) { return s.uv.x; }\n"
        "KERNEL vec3 x_reflect_ambient(Surface s) { return vec3(x_helper(s)); }\n"
        "KERNEL Reflected x_reflect(Surface s, vec3 to_light) { return Reflected(tangent_or_any(s), "
        "s.color); }\n");
    CHECK(model.reads.surface == std::set<std::string>{"color", "normal", "tangent", "uv"});
    CHECK(model.structure.empty());
    const std::string source = kl::plugin_source(model, "x.kernel");
    CHECK(holds(source, "reads_tangent | reads_uv>"));
}

TEST_CASE("the kind of a model follows from its functions") {
    const kl::ModelDeclaration shading = model_in(
        "/// rate: face\nKERNEL vec3 x_y_normal(ShadingPoint p, Triangle t) { return p.face_normal; }\n",
        "x-y");
    CHECK(shading.kind == candela::PluginKind::shading);
    CHECK(shading.prefix == "x_y");
    CHECK(shading.rate == "face");
    CHECK(shading.takes_triangle);
    const kl::ModelDeclaration light = model_in(
        "struct XLight { float power; };\n"
        "KERNEL Incident x_illuminate(XLight light, Receiver r) { return Incident(vec3(0.0f, 1.0f, 0.0f), "
        "vec3(light.power), vec3(light.power)); }\n");
    CHECK(light.kind == candela::PluginKind::light);
    CHECK(light.reads.receiver.empty());
    CHECK(holds(kl::plugin_source(light, "x.kernel"), "distant_light("));
    CHECK_THROWS_AS(model_in("KERNEL float other_reflect(Surface s) { return 1.0f; }\n"), kl::Problem);
    CHECK_THROWS_AS(model_in("KERNEL Reflected x_reflect(Surface s, vec3 l) { return Reflected(l, l); }\n"),
                    kl::Problem);
}

TEST_CASE("a model's name is its file's, in lower case") {
    CHECK(kl::model_name("a/half-lambert.kernel") == "half-lambert");
    for (const char* const name :
         {"Phong.kernel", "2.kernel", "phong.txt", ".kernel", "a b.kernel", "a--b.kernel", "a-.kernel"})
        CHECK_THROWS_AS(kl::model_name(name), std::invalid_argument);
}

TEST_CASE("comments cannot add code to the plugin that is compiled") {
    const kl::ModelDeclaration model = model_with("float a;  /// = 1: \"; } int system(const char*); // \\\"",
                                                  "/// # \"});\n/// ?\?/\" \x01 x\n");
    const std::string source = kl::plugin_source(model, "x.kernel");
    CHECK(holds(source, R"(.title = "\"});")"));
    CHECK(holds(source, R"(.meaning = "\"; } int system(const char*); // \\\"")"));
    CHECK_FALSE(holds(source,
                      "?"
                      "?"));
    CHECK(source.find('\x01') == std::string::npos);
}

TEST_CASE("equations in TeX are printed as text") {
    for (const auto& [tex, text] : {
             std::pair{R"(I_s = k_s I_L \max(R \cdot V, 0)^\text{shininess})",
                       "I_s = k_s I_L max(R.V, 0)^shininess"},
             std::pair{R"(\frac{1 + N \cdot L}{2} k)", "(1 + N.L) / 2 k"},
             std::pair{R"(\frac{F D G}{4 N \cdot V})", "F D G / (4 N.V)"},
             std::pair{R"(\left(\frac{a}{b}\right)^{n - 1})", "(a / b)^(n - 1)"},
             std::pair{R"(\sqrt{\alpha^2 + 1} \le \pi, \quad x \times y)", "sqrt(alpha^2 + 1) <= pi,  x x y"},
             std::pair{R"(\lceil b \rceil \, \text{edge\_u})", "ceil(b) edge_u"},
             std::pair{R"(\unknown{a} {b)", "unknowna b"},
         })
        CHECK(kl::plain_text(tex) == text);
}
