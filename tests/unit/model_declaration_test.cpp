// The declarations in a kernel file's comments: what they say of a model, and which of them are refused.
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers.hpp>
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
                   "/// properties: isotropic, reciprocal = where kd is 1 or 2\n"
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
    CHECK(model.properties[1].name == "reciprocal");
    CHECK(model.properties[1].value == "where kd is 1 or 2");
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
                  "x.kernel:2:21: expected 1 number as the default of 'a', got 2"},
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

TEST_CASE("declarations that no scene could use are reported at their place") {
    struct Case {
        const char* member;
        const char* comment;
        const char* problem;
    };
    for (const auto& [member, comment, problem] : {
             Case{"float a;  /// = 10 [10000, 0]: m", "",
                  "x.kernel:2:24: the range of 'a' is empty: from 10000 to 0"},
             Case{"float a;  /// = 1 [1, 1): m", "", "x.kernel:2:23: the range of 'a' is empty: from 1 to 1"},
             Case{"float a;  /// = 99999 [0, 10000]: m", "",
                  "x.kernel:2:21: the default of 'a': 99999 is outside its range: 0 to 10000"},
             Case{"vec3 a;  /// = 0.5 0.5 2 [0, 1]: m", "",
                  "x.kernel:2:20: the default of 'a': [0.5, 0.5, 2] is outside its range: 0 to 1"},
             Case{"int a;  /// = 2.5: m", "", "x.kernel:2:19: 'a' is an integer, which cannot be 2.5"},
             Case{"int a;  /// = b | c | b: m", "", "x.kernel:2:19: 'b' is a choice already"},
             Case{"vec3 a;  /// direction = 0 0 0: m", "",
                  "x.kernel:2:30: the default of 'a': a direction cannot be zero"},
             Case{"float a;  /// = 1: m", "/// properties: isotropic, reciprocl\n",
                  "x.kernel:1:28: unknown property 'reciprocl'; did you mean 'reciprocal'? (known: "
                  "reciprocal, "
                  "energy-bounded, isotropic, lights-below-horizon, may-be-negative, fixed-in-world)"},
             Case{"float a;  /// = 1: m", "/// properties: closed\n",
                  "x.kernel:1:17: 'closed' is a property of a shape plugin, not of a reflection plugin"},
             Case{"float a;  /// = 1: m", "/// properties: isotropic, isotropic\n",
                  "x.kernel:1:28: 'isotropic' is declared already"},
             Case{"float a;  /// = 1: m", "/// properties: reciprocal = where b is 1\n",
                  "x.kernel:1:17: the property 'reciprocal' is 'where b is 1'; it has no parameter 'b'"},
             Case{"float a;  /// = 1: m", "/// requires: a < c because so it is\n",
                  "x.kernel:1:15: the relation \"a is less than c: so it is\" is about 'c', but there is no "
                  "such parameter; did you mean 'a'?"},
             Case{"float a, b;  /// = 1: m", "/// requires: a < b because so it is\n",
                  "x.kernel:1:15: the defaults: a (1) must be less than b (1): so it is"},
             Case{"float a;  /// = 1 [0, 1]: m", "/// preset: p (s): a = 2\n",
                  "x.kernel:1:13: preset 'p' has 2 for 'a': 2 is outside its range: 0 to 1"},
             Case{"float a;  /// = 1: m", "/// preset: p (s): b = 2\n",
                  "x.kernel:1:13: preset 'p' sets 'b', but there is no such parameter"},
             Case{"float a;  /// = 1: m", "/// preset: p (s): a = 2 3\n",
                  "x.kernel:1:13: 'a' takes 1 number, got 2"},
             Case{"float a;  /// = 1: m", "/// presets: classic\n",
                  "x.kernel:1:5: the presets 'classic' need a parameter 'ka', a vec3 or a float"},
             Case{"float a;  /// = 1: m", "/// rate: face\n",
                  "x.kernel:1:5: only a shading model has a rate"},
         }) {
        INFO(member << " " << comment);
        CHECK(problem_with(member, comment) == problem);
    }
}

TEST_CASE("a parameter cannot have the name of a key that the scene's own table has") {
    const auto problem_in = [](const std::string& text) -> std::string {
        try {
            static_cast<void>(model_in(text));
            return "";
        } catch (const kl::Problem& problem) {
            return problem.text();
        }
    };
    for (const std::string name : {"type", "name"}) {
        CHECK(problem_in(
                  "struct XLight { float " + name +
                  "; };\nKERNEL vec3 x_illuminate_ambient(XLight m, Receiver r) { return vec3(1.0f); }\n") ==
              "x.kernel:1:23: '" + name +
                  "' is a key of [[light]] itself, so that a scene cannot set a parameter of that name; "
                  "choose another");
        CHECK(problem_with("float " + name + ";  /// = 1: m") == "");  // it is in [object.material]
    }
    CHECK(problem_in(
              "struct XNormal { float model; };\nKERNEL vec3 x_normal(XNormal m, ShadingPoint p) { return "
              "p.face_normal; }\n")
              .starts_with("x.kernel:1:24: 'model' is a key of [shading] itself"));
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
    CHECK_THROWS_WITH(
        model_in("\nKERNEL float other_one_reflect(Surface s) { return 1.0f; }\n"),
        "a model named 'x' needs a function x_reflect (a reflection model), x_illuminate or "
        "x_illuminate_ambient (a light) "
        "or x_normal (a shading model); this is other_one_reflect, of a model named 'other-one'");
    CHECK_THROWS_AS(model_in("KERNEL float other(Surface s) { return 1.0f; }\n"), kl::Problem);
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
         })
        CHECK(kl::plain_text(tex) == text);
}

TEST_CASE("mistakes in an equation are reported at their place") {
    for (const auto& [tex, problem] : {
             std::pair{R"(a \frc{1}{2})",
                       R"(x.kernel:1:10: unknown command '\frc' in an equation; did you mean '\frac'?)"},
             std::pair{R"(\unheard{a})", R"(x.kernel:1:8: unknown command '\unheard' in an equation)"},
             std::pair{R"({a + b)", "x.kernel:1:8: this '{' is not closed"},
             std::pair{R"(a + b})", "x.kernel:1:13: this '}' has no opening '{'"},
             std::pair{R"(\frac{a})", "x.kernel:1:16: expected an argument"},
         })
        CHECK(problem_with("float a;  /// = 1: m", "/// $$ " + std::string(tex) + " $$\n") == problem);
    // In an equation of several lines, too.
    CHECK(problem_with("float a;  /// = 1: m", "/// $$ a +\n/// \\frc{1}{2} $$\n")
              .starts_with("x.kernel:2:5: unknown command"));
}
