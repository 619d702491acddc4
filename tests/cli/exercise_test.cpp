// candela exercise: answers by RE's equations match, RE's own mistakes are found in the right term, and
// hostile answers are refused.
#include <algorithm>
#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/text.h"

namespace fs = std::filesystem;
using Catch::Approx;
using nlohmann::json;

namespace {

/// Phong's model as RE and SPEC §4 write it: R = 2 N (N.L) - L, I_d = kd C_o max(N.L, 0), I_s = ks max(R.V,
/// 0)^n.
constexpr const char* k_phong =
    "vec3 N = s.normal;\n"
    "vec3 R = 2.0 * N * dot(N, to_light) - to_light;\n"
    "float lit = dot(N, to_light) > 0.0 ? 1.0 : 0.0;\n"
    "float highlight = dot(R, s.to_observer) > 0.0 ? pow(dot(R, s.to_observer), m.shininess) : 0.0;\n"
    "if (m.shininess == 0.0) highlight = 1.0;\n"
    "return Reflected(m.kd * s.color * max(dot(N, to_light), 0.0), m.ks * lit * highlight);";

json json_lines_of(const std::string& text) {
    json lines = json::array();
    for (std::size_t begin = 0;;) {
        const std::size_t end = text.find('\n', begin);
        lines.push_back(text.substr(begin, end - begin));
        if (end == std::string::npos) return lines;
        begin = end + 1;
    }
}

fs::path answer(const fs::path& file, const std::string& body, const std::string& model = "reflection/phong",
                const std::string& function = "phong_reflect") {
    const json content = {
        {"candela_exercise", 1}, {"model", model}, {"function", function}, {"answer", json_lines_of(body)}};
    return write_file(file, content.dump(-1, ' ', false, json::error_handler_t::replace));
}

struct Graded {
    int exit_code;
    json grades;
};

Graded graded(std::vector<std::string> words) {
    words.insert(words.begin(), {"exercise", "grade"});
    words.emplace_back("--json");
    const CommandResult result = run_candela(words);
    INFO(result.err);
    INFO(result.out);
    const json grades = json::parse(result.out, nullptr, false);
    REQUIRE(grades.is_array());
    return {result.exit_code, grades};
}

json grade_of(const std::string& body, const std::string& model = "reflection/phong",
              const std::string& function = "phong_reflect") {
    return graded({answer(scratch_directory() / "one.answer", body, model, function).string()}).grades.at(0);
}

double share_of(const json& grade, const std::string& name) {
    for (const json& term : grade["terms"])
        if (term["term"] == name) return term["share"];
    FAIL("missing term " << name);
    return 0;
}

json term_of(const json& grade, const std::string& name) {
    for (const json& term : grade["terms"])
        if (term["term"] == name) return term;
    FAIL("missing term " << name);
    return {};
}

}  // namespace

TEST_CASE("exercise: Phong's equations as written in RE match the model") {
    const Graded result = graded({answer(scratch_directory() / "one.answer", k_phong).string()});
    CHECK(result.exit_code == 0);
    CHECK(result.grades.at(0)["result"] == "matches");
    CHECK(result.grades.at(0)["model"] == "reflection/phong");
}

TEST_CASE("exercise: RE's mistake, an even power of a negative R.V, is found only in the highlight") {
    // RE's third worked example: R.V = -0.5514, and 10 is even, so there would be a highlight of 0.0026.
    const std::string mistaken =
        replaced(k_phong, "dot(R, s.to_observer) > 0.0 ? pow(dot(R, s.to_observer), m.shininess) : 0.0",
                 "pow(abs(dot(R, s.to_observer)), m.shininess)");
    const json grade = grade_of(mistaken);
    CHECK(grade["result"] == "differs");
    const json specular = term_of(grade, "specular");
    CHECK(specular["share"].get<double>() > 0);
    CHECK(specular["expected"].get<double>() == 0);
    CHECK(specular["actual"].get<double>() > 0);
    CHECK(share_of(grade, "diffuse") == 0);
    CHECK(share_of(grade, "ambient") == 0);
}

TEST_CASE("exercise: half of the diffuse light is off by half, wherever there is any") {
    const json grade = grade_of(replaced(k_phong, "m.kd * s.color", "0.5 * m.kd * s.color"));
    CHECK(grade["result"] == "differs");
    const json diffuse = term_of(grade, "diffuse");
    CHECK(diffuse["largest"].get<double>() == Approx(0.5).epsilon(1e-5));
    CHECK(diffuse["actual"].get<double>() == Approx(0.5 * diffuse["expected"].get<double>()).epsilon(1e-5));
    // Half of all directions to the light are above the surface; where kd is 0 nothing can differ.
    CHECK(diffuse["share"].get<double>() < 0.55);
    CHECK(diffuse["share"].get<double>() > 0.35);
    CHECK(share_of(grade, "specular") == 0);
}

TEST_CASE("exercise: ambient light has a function and a term of its own") {
    CHECK(grade_of("return m.ka * s.color;", "reflection/phong", "phong_reflect_ambient")["result"] ==
          "matches");
    const json grade = grade_of("return s.color;", "phong", "reflect_ambient");
    CHECK(grade["result"] == "differs");
    CHECK(share_of(grade, "ambient") > 0.5);
    CHECK(share_of(grade, "diffuse") == 0);
}

TEST_CASE(
    "exercise: a folder is graded file by file, as a table, and errors in one answer do not affect the "
    "others") {
    const Folder folder;
    answer(folder / "a.answer", k_phong);
    answer(folder / "b.answer", replaced(k_phong, "2.0 * N", "N"));
    answer(folder / "c.answer", replaced(k_phong, "vec3 N = s.normal;", "vec3 N = s.normal"));
    folder.write("d.answer", "not JSON");
    folder.write("notes.txt", "not an answer, and not asked for");
    const CommandResult result =
        expect_out(run_candela({"exercise", "grade", folder.path().string()}), 4,
                   {"a.answer  reflection/phong phong_reflect  matches\n",
                    "b.answer  reflection/phong phong_reflect  differs\n", "specular: "});
    // The error is where the text is missing, at the end of line 1.
    CHECK(
        holds(result.out, "does not compile: line 1, column 18: expected an operator or ';' before 'vec3'"));
    CHECK(holds(result.out, "it is not a JSON object"));
    CHECK(!holds(result.out, "notes.txt"));
}

TEST_CASE("exercise: text outside the kernel language is refused at its line, before it is compiled") {
    struct Hostile {
        const char* text;
        const char* message;
    };
    const Folder folder;
    const std::vector<Hostile> texts = {
        {"vec3 *p = (vec3 * const) 16; vec3 x = *p;", "neither pointers nor references"},
        {"float address = float((uint64_t) &s);", "neither pointers nor references"},
        {"Surface &t = s;", "neither pointers nor references"},
        {"int* p = &n; *p = 1;", "neither pointers nor references"},
        {"int n = 0; *(int*)8 = n;", "neither pointers nor references"},
        {"#include \"/etc/passwd\"", "no preprocessor"},
        {"_Pragma(\"GCC poison pow\")", "no strings"},
        {"__asm__(\"syscall\");", "no strings"},
        {"asm volatile(1);", "no 'asm'"},
        {"[[gnu::noreturn]] int x = 0;", "neither arrays nor attributes"},
        {"float a[1000000000];", "neither arrays nor attributes"},
        {"std::exit(0);", "no '::'"},
        {"}\nvoid f() {", "has no opening '{'"},
        {"{", "not closed"},
        {"// a comment that goes on \\\n#include <x>", "must not end with"},
        {"while (true) { }", "a loop needs a constant bound"},
        {"float x = exit(0);", "unknown function 'exit'"},
    };
    for (std::size_t i = 0; i < texts.size(); ++i)
        answer(folder / (std::to_string(100 + i) + ".answer"), std::string(texts[i].text) + "\n" + k_phong);
    answer(folder / "deep.answer", "float x = " + std::string(5000, '(') + "1.0" + std::string(5000, ')') +
                                       ";\nreturn Reflected(s.color, s.color);");
    answer(folder / "long.answer", std::string(50000, ' ') + k_phong);
    answer(folder / "nothing.answer", "");
    const Graded result = graded({folder.path().string()});
    CHECK(result.exit_code == 4);
    REQUIRE(result.grades.size() == texts.size() + 3);
    for (std::size_t i = 0; i < result.grades.size(); ++i) {
        const json& grade = result.grades[i];
        INFO(grade.dump(-1, ' ', false, json::error_handler_t::replace));
        CHECK(grade["result"] == "does-not-compile");
        if (i < texts.size()) CHECK(holds(grade["message"], texts[i].message));
        CHECK(grade["line"].is_number());
        CHECK(grade["column"].is_number());
    }
}

TEST_CASE("exercise: an answer that calls itself, or takes too long, does not run forever") {
    const Folder folder;
    answer(folder / "recursion.answer", "return phong_reflect(m, s, to_light);");
    answer(folder / "steps.answer",
           "float x = 1.0;\nfor (int i = 0; i < 300; ++i) for (int j = 0; j < 300; ++j) x += sin(x) * cos(x) "
           "+ pow(x, 0.1);\n"
           "return Reflected(s.color * x, s.color);");
    const json grades = graded({folder.path().string()}).grades;
    CHECK(holds(grades.at(0)["message"], "calls itself"));
    CHECK(holds(grades.at(1)["message"], "more than 1000000 steps"));
    CHECK(grades.at(1)["line"] == 2);
}

TEST_CASE("exercise: a name that is a C++ macro is an error, and is not expanded") {
    const json grade = grade_of(
        "float UINT64_C = 1.0;\nfloat INT8_MAX = UINT64_C;\nreturn Reflected(s.color * INT8_MAX, s.color);");
    CHECK(grade["result"] == "does-not-compile");
    CHECK(holds(grade["message"], "is a macro of C++; choose another name"));
}

TEST_CASE("exercise: unassigned variables are zero, and no index or integer overflow escapes its bounds") {
    const Folder folder;
    answer(
        folder / "a.answer",
        "Reflected r;\nr.diffuse.x = 0.0;\nint zero = int(m.shininess * 0.0);\nint a = 1 / zero + 1 % zero;\n"
        "int big = 2147483647;\nbig += 1 - zero;\na += int(1.0e30 * m.shininess) + big / (zero - 1);\n"
        "r.specular = vec3(0.0 * float(a));\nreturn r;");
    const json grade = graded({folder.path().string()}).grades.at(0);
    INFO(grade.dump());
    // The formula is wrong, but its results are numbers, all zero.
    CHECK(grade["result"] == "differs");
    for (const json& term : grade["terms"])
        if (term.contains("actual")) CHECK(term["actual"].get<double>() == 0);
}

TEST_CASE("exercise: the shipped models' own formulas are right answers", "[programs]") {
    // The whole kernel, written again from its parsed form, gives the plugin's results.
    const fs::path folder = scratch_directory(),
                   plugins = fs::path(CANDELA_TEST_SOURCE) / "plugins/reflection";
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(plugins)) {
        const fs::path file = entry.path();
        const std::string name = file.stem().string();
        if (file.extension() != ".kernel" || name == "dielectric") continue;
        std::string prefix = name, text = read_file(file);
        std::ranges::replace(prefix, '-', '_');
        const std::size_t at = text.find(" " + prefix + "_reflect(");
        REQUIRE(at != std::string::npos);
        const std::size_t begin = text.find("{\n", at) + 2;
        answer(folder / (name + ".answer"), text.substr(begin, text.find("\n}", begin) - begin),
               "reflection/" + name, prefix + "_reflect");
        ++count;
    }
    const Graded result = graded({folder.string()});
    CHECK(count > 10);
    CHECK(result.exit_code == 0);
    for (const json& grade : result.grades) {
        INFO(grade.dump());
        CHECK(grade["result"] == "matches");
    }
}

TEST_CASE("exercise: files that are not answers get a reason, and do not prevent grading the others") {
    const Folder folder;
    answer(folder / "a.answer", k_phong);
    answer(folder / "b.answer", k_phong, "reflection/phnog");
    answer(folder / "c.answer", k_phong, "reflection/phong", "phong_reflekt");
    answer(folder / "d.answer", k_phong, "target/cpp");
    answer(folder / "e.answer", k_phong, "reflection/../../../etc/passwd");
    folder.write("f.answer", R"({"candela_exercise": 2})");
    folder.write("g.answer",
                 R"({"candela_exercise": 1, "model": "phong", "function": "reflect", "answer": ["a\nb"]})");
    folder.write("h.answer", std::string(200000, '['));
    const json grades = graded({folder.path().string()}).grades;
    REQUIRE(grades.size() == 8);
    CHECK(grades[0]["result"] == "matches");
    const std::vector<const char*> messages = {
        "",       "did you mean 'phong'", "did you mean 'phong_reflect'", "is not a reflection model",
        "passwd", "'candela_exercise'",   "not a line of text",           "larger than"};
    for (std::size_t i = 1; i < grades.size(); ++i) {
        INFO(grades[i].dump());
        CHECK(grades[i]["result"] == "no-answer");
        CHECK(holds(grades[i]["message"], messages[i]));
    }
}

#if defined(__x86_64__)
TEST_CASE("exercise: if the language does not prevent it, a system call ends the computing process") {
    // Bypasses the language check of candela exercise grade by calling the conformance kit directly.
    const fs::path command = CANDELA_TEST_COMMAND, root = command.parent_path().parent_path();
    const std::string kernel =
        "struct PhongMaterial { vec3 ka; vec3 kd; vec3 ks; float shininess; };\n"
        "KERNEL vec3 phong_reflect_ambient(PhongMaterial m, Surface s) { return m.ka * s.color; }\n"
        "KERNEL Reflected phong_reflect(PhongMaterial m, Surface s, vec3 to_light) { STATEMENT return "
        "Reflected(s.color, s.color); }\n";
    struct Statement {
        const char* text;
        const char* found;
    };
    for (const Statement& statement : {
             Statement{"long r = 57; asm volatile(\"syscall\" : \"+a\"(r) : : \"rcx\", \"r11\", \"memory\");",
                       "SYS"},  // fork
             Statement{"long r = 41; asm volatile(\"syscall\" : \"+a\"(r) : : \"rcx\", \"r11\", \"memory\");",
                       "SYS"},  // socket
             Statement{"long r = 2; asm volatile(\"syscall\" : \"+a\"(r) : : \"rcx\", \"r11\", \"memory\");",
                       "SYS"},  // open
             Statement{"*(volatile int*)8 = 1;", "SEGV"},
             Statement{"for (;;) { }", ""},
         }) {
        const fs::path file =
            write_file(scratch_directory() / "answer.kernel", replaced(kernel, "STATEMENT", statement.text));
        const CommandResult result = run_program({(root / "lib/candela/candela-conformance").string(),
                                                  (root / "lib/candela/plugins/reflection-phong.so").string(),
                                                  "--answer", file.string(), "--json"});
        INFO(result.out);
        const std::string found = *statement.found == '\0'
                                      ? R"({\"hangs\":true})"
                                      : std::string(R"({\"signal\":\")") + statement.found;
        CHECK(holds(result.out, found));
    }
}
#endif

TEST_CASE("exercise: the process that runs an answer has neither the plugin nor its results") {
    // Bypasses the language check again, and reads all readable memory, which a kernel cannot do.
    const fs::path command = CANDELA_TEST_COMMAND, root = command.parent_path().parent_path();
    const std::string kernel =
        "extern \"C\" int dl_iterate_phdr(int (*)(void*, unsigned long, void*), void*);\n"
        "static inline int candela_seen(void* info, unsigned long, void* found) {\n"
        "    for (const char* c = static_cast<char**>(info)[1]; *c != 0; ++c)\n"
        "        if (__builtin_memcmp(c, \"reflection-phong.so\", 19) == 0) *static_cast<bool*>(found) = "
        "true;\n"
        "    return 0;\n}\n"
        "struct PhongMaterial { vec3 ka; vec3 kd; vec3 ks; float shininess; };\n"
        "KERNEL vec3 phong_reflect_ambient(PhongMaterial m, Surface s) { return m.ka * s.color; }\n"
        "KERNEL Reflected phong_reflect(PhongMaterial m, Surface s, vec3 to_light) { bool found = false;\n"
        "    dl_iterate_phdr(candela_seen, &found); return Reflected(vec3(found ? 1000.0f : 2000.0f), "
        "s.color); }\n";
    const fs::path file = write_file(scratch_directory() / "answer.kernel", kernel);
    const CommandResult result = run_program({(root / "lib/candela/candela-conformance").string(),
                                              (root / "lib/candela/plugins/reflection-phong.so").string(),
                                              "--answer", file.string(), "--json"});
    INFO(result.out);
    const json checks = json::parse(result.out).at(0)["checks"];
    const json found = json::parse(checks.at(0)["messages"].at(0).get<std::string>());
    // For a light of intensity about 1: 2000 if nothing is found, otherwise 1000.
    CHECK(term_of(found, "diffuse")["actual"].get<double>() > 1500);
}

TEST_CASE("exercise: the page contains results of the model, but not the formula") {
    const fs::path page = scratch_directory() / "phong.html";
    succeeded(
        run_candela({"exercise", "new", "reflection/phong", "--blank", "reflect", "-o", page.string()}));
    const std::string text = read_file(page);
    // From phong.kernel, and from the output of candela describe.
    for (const char* const part :
         {"n_dot_l * s.normal", "clamped_power(dot", "R = 2 N", "max(R.V", "kd C_o I_L", "m.ks *"})
        CHECK(!holds(text, part));
    // The rest of the kernel is on the page.
    CHECK(holds(text, "return m.ka * s.color;"));
    CHECK(holds(text, "\"function\":\"phong_reflect\""));
    CHECK(!holds(text, "http://127"));
    CHECK(!holds(text, " src="));
}

TEST_CASE("exercise: every model whose kernel reads no table has exercises") {
    const Folder folder;
    for (const char* const model :
         {"lambert", "half-lambert", "oren-nayar", "eon", "minnaert", "phong", "blinn-phong", "cook-torrance",
          "beckmann", "ggx", "disney", "metallic-roughness", "specular-glossiness", "openpbr", "ward",
          "ashikhmin-shirley", "kajiya-kay", "toon", "gooch"}) {
        const CommandResult result = folder.run_words({"exercise", "new", model, "--blank", "reflect"});
        INFO(model << ": " << result.err);
        CHECK(result.exit_code == 0);
        CHECK(fs::exists(folder / (std::string(model) + "-reflect.html")));
    }
}

TEST_CASE("exercise: an impossible exercise is an error that lists the possible ones") {
    struct Wrong {
        std::vector<std::string> words;
        const char* message;
    };
    for (const Wrong& wrong : {
             Wrong{{"new"}, "needs a model"},
             Wrong{{"new", "phong"}, "--blank is missing"},
             Wrong{{"new", "phong", "--blank", "reflcet"}, "did you mean 'reflect'"},
             Wrong{{"new", "light/point", "--blank", "illuminate"}, "is not a reflection model"},
             Wrong{{"grade"}, "needs answers"},
             Wrong{{"grade", ".", "--time-limit", "0"}, "expected more than 0"},
             Wrong{{"grad"}, "did you mean 'grade'"},
         }) {
        std::vector<std::string> words = wrong.words;
        words.insert(words.begin(), "exercise");
        const Folder folder;
        expect(folder.run_words(words), 2, {wrong.message});
        CHECK(fs::is_empty(folder));
    }
    expect(run_candela({"exercise", "grade", "/nonexistent"}), 1);
    expect(run_candela({"exercise", "new", "phnog", "--blank", "reflect"}), 1);
}

TEST_CASE("exercise: an error by a factor of thousands is reported as such, not in per cent") {
    const fs::path file = answer(scratch_directory() / "one.answer",
                                 replaced(k_phong, "m.kd * s.color", "70000.0 * m.kd * s.color"));
    const CommandResult result = expect_out(run_candela({"exercise", "grade", file.string()}), 4,
                                            {", by more than 1000 times the largest value"});
    CHECK_FALSE(holds(result.out, "000 %"));
}
