// candela exercise grade: compares answers with the models' own results.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "candela/kernel_language/language.h"
#include "cli/command_line.h"
#include "commands/exercise.h"
#include "console/exit_code.h"
#include "console/reporting.h"
#include "console/terminal.h"
#include "exercise/exercises.h"
#include "json/json.h"
#include "process/process.h"
#include "programs/sibling_program.h"
#include "sandbox/temporary_folder.h"

import candela.util;

namespace kl = candela::kernel_language;
namespace po = boost::program_options;
namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

namespace {

enum class Result { matches, differs, does_not_compile, hangs, crashes, is_no_answer };

/// The name of the result in JSON.
const char* name_of(Result result) {
    switch (result) {
        case Result::matches:
            return "matches";
        case Result::differs:
            return "differs";
        case Result::does_not_compile:
            return "does-not-compile";
        case Result::hangs:
            return "hangs";
        case Result::crashes:
            return "crashes";
        case Result::is_no_answer:
            return "no-answer";
    }
    return "?";
}

struct Grade {
    fs::path file;
    std::string model, function;  // as named in the answer
    Result result = Result::is_no_answer;
    std::string message;         // what is wrong, other than the numbers
    std::size_t line = 0;        // of the answer, if the message is about one
    std::size_t column = 0;      // like `line`
    Json terms = Json::array();  // as the conformance kit reports them
};

constexpr const char* k_answer = "answer";  // the name of its text in messages

/// Takes the compiler's first error in the answer, such as a name that a header defines as a macro.
void take_refusal(Grade& grade, const std::string& log) {
    grade.result = Result::does_not_compile;
    static const std::regex k_error(fmt::format(R"(\b{}:(\d+):(\d+): (?:fatal )?error: ([^\n]*))", k_answer));
    static const std::regex k_macro(R"(error: ('\w+' is a macro of C\+\+; choose another name))");
    std::smatch found;
    if (std::regex_search(log, found, k_macro)) {
        grade.message = found[1];
        return;
    }
    if (!std::regex_search(log, found, k_error)) {
        grade.message = log.substr(0, log.find('\n', log.find('\n') + 1));
        return;
    }
    grade.message = found[3];
    grade.line = std::stoul(found[1]);
    grade.column = std::stoul(found[2]);
}

/// The exercise's kernel with the answer in it, as C++; or nothing, after storing what is wrong with the
/// answer.
std::optional<std::string> compilable(const Exercise& exercise, const std::string& answer, Grade& grade) try {
    return kl::emitted(kl::read_kernel(exercise.kernel, kl::Body{exercise.function, {k_answer, answer}}),
                       kl::Emission::guarded_cpp);
} catch (const kl::Problem& problem) {
    grade.result = Result::does_not_compile;
    grade.message = problem.what();
    if (problem.file() == k_answer) {
        grade.line = problem.line();
        grade.column = problem.column();
    }
    return std::nullopt;
}

/// The conformance kit's verdict on the kernel in `text`, which contains an answer.
Json judged_by_kit(const fs::path& kit, const Exercise& exercise, const fs::path& text, double seconds) {
    const candela::ProgramOutput output =
        candela::run_program({kit.string(), exercise.plugin->library.string(), "--answer", text.string(),
                              "--json", "--time-limit", fmt::format("{}", seconds)});
    const Json report = json_or_discarded(output.out);
    if (report.is_array() && !report.empty()) {
        const Json& check = report[0]["checks"][0];
        const std::string outcome = check["outcome"];
        if (outcome == "timed out") return {{"hangs", true}};
        for (const Json& message : check["messages"]) {
            const Json found = json_or_discarded(message.get<std::string>());
            if (found.is_object()) return found;
            if (outcome == "failed" || outcome == "skipped" || outcome == "crashed")
                throw Error(ErrorCategory::failure,
                            fmt::format("the conformance kit cannot grade: {}", message.get<std::string>()));
        }
    }
    throw Error(ErrorCategory::failure, fmt::format("the conformance kit has failed: {}", output.err));
}

class Grader {
  public:
    Grader(candela::Registry& registry, double seconds)
        : registry_(registry), seconds_(seconds), kit_(conformance_kit()), folder_("candela-exercise-") {}

    Grade grade(const fs::path& file) {
        Grade grade{.file = file, .model = {}, .function = {}, .message = {}};
        std::optional<Answer> answer;
        std::optional<Exercise> exercise;
        try {
            answer = answer_from(file);
            grade.model = answer->model;
            grade.function = answer->function;
            if (candela::is_kernel_file(answer->model) && !fs::exists(answer->model))
                throw Error(
                    ErrorCategory::bad_request,
                    fmt::format("it is about the kernel file '{}', which does not exist in this folder; run "
                                "the command where the exercise was made",
                                answer->model));
            exercise = exercise_about(answer->model, answer->function, registry_);
        } catch (const Error& problem) {
            grade.message = problem.what();
            return grade;
        }
        const std::optional<std::string> kernel = compilable(*exercise, answer->body, grade);
        if (!kernel) return grade;
        const fs::path text = folder_.path() / "answer.kernel";
        candela::write_text_file(text, *kernel);
        const Json found = judged_by_kit(kit_, *exercise, text, seconds_);
        if (found.contains("refused")) {
            take_refusal(grade, found["refused"]);
        } else if (found.contains("hangs")) {
            grade.result = Result::hangs;
            grade.message = "it does not finish";
        } else if (found.contains("signal")) {
            grade.result = Result::crashes;
            grade.message = fmt::format("it was killed by SIG{}", found["signal"].get<std::string>());
        } else {
            grade.result = found["matches"] ? Result::matches : Result::differs;
            grade.terms = found["terms"];
        }
        return grade;
    }

  private:
    candela::Registry& registry_;
    double seconds_;
    fs::path kit_;
    TemporaryFolder folder_;
};

std::string percent(double share) {
    const double value = 100 * share;
    return value > 0 && value < 0.1 ? "< 0.1 %" : fmt::format("{:.{}f} %", value, value < 10 ? 1 : 0);
}

/// A share of another value: "by up to 40 % of", "by more than 1000 times".
std::string multiple(double share) {
    if (share < 10) return fmt::format("by up to {} of", percent(share));
    return share < 1000 ? fmt::format("by up to {:.0f} times", share) : "by more than 1000 times";
}

/// "specular: 3.9 % of the points differ, by up to 100 % of the largest value".
std::string term_text(const Json& term) {
    const std::string text = fmt::format("{}: {} of the points differ", term["term"].get<std::string>(),
                                         percent(term["share"].get<double>()));
    if (!term["largest"].is_number()) return text + "; some are not numbers";
    return text + fmt::format(", {} the largest value", multiple(term["largest"].get<double>()));
}

/// The result of grading, in a line.
std::string summary_of(const Grade& grade) {
    std::string text = grade.result == Result::does_not_compile ? "does not compile" : name_of(grade.result);
    if (grade.result == Result::is_no_answer) return grade.message;
    if (grade.line > 0) text += fmt::format(": line {}, column {}", grade.line, grade.column);
    if (!grade.message.empty()) text += ": " + grade.message;
    return text;
}

/// A row per answer; differing ones are followed by how they differ.
std::string table(const std::vector<Grade>& grades) {
    std::vector<std::array<std::string, 2>> cells;
    std::array<std::size_t, 2> widths{};
    for (const Grade& grade : grades) {
        cells.push_back(
            {candela::printable(grade.file.string()),
             candela::printable(candela::shortened(fmt::format("{} {}", grade.model, grade.function)))});
        for (std::size_t i = 0; i < widths.size(); ++i)
            widths[i] = std::max(widths[i], candela::character_count(cells.back()[i]));
    }
    const auto padded = [](const std::string& text, std::size_t width) {
        return text + std::string(width + 2 - candela::character_count(text), ' ');
    };
    std::string text;
    for (std::size_t row = 0; row < grades.size(); ++row) {
        const Grade& grade = grades[row];
        const std::string indent = "    ";
        text += padded(cells[row][0], widths[0]) + padded(cells[row][1], widths[1]) +
                candela::printable(summary_of(grade)) + "\n";
        if (grade.result != Result::differs) continue;
        for (const Json& term : grade.terms) {
            if (!term.contains("at")) continue;
            text += fmt::format("{}{}\n", indent, term_text(term));
            text += fmt::format("{}  most for {}\n{}  with {}\n", indent, term["at"].get<std::string>(),
                                indent, term["with"].get<std::string>());
        }
    }
    return text;
}

Json json_of(const Grade& grade) {
    Json result = {{"file", grade.file.string()}, {"model", grade.model},
                   {"function", grade.function},  {"result", name_of(grade.result)},
                   {"message", grade.message},    {"terms", grade.terms}};
    result["line"] = grade.line > 0 ? Json(grade.line) : Json();
    result["column"] = grade.column > 0 ? Json(grade.column) : Json();
    return result;
}

}  // namespace

int run_exercise_grade(const std::vector<std::string>& arguments) {
    CommandLine line("candela exercise grade FILE|FOLDER... [options]",
                     "Grade answers saved by the pages of `candela exercise new`: check whether the formula "
                     "gives the model's own numbers, as the conformance kit compares them, and if not, show "
                     "how far off each term is. In folders, grade the files named *.answer. Each answer is "
                     "compiled and run in a process of its own that can do nothing but compute.");
    line.positional("answer", -1);
    line.options()("json", "print JSON, with the point at which each term differs most")(
        "time-limit", po::value<double>()->value_name("SECONDS")->default_value(30, "30"),
        "time limit for each answer");
    add_plugin_options(line);
    if (!line.parse(arguments)) return 0;
    const auto seconds = line.get<double>("time-limit");
    if (!(seconds > 0))
        throw Error(ErrorCategory::bad_request,
                    fmt::format("--time-limit is {}; expected more than 0", seconds));
    const std::vector<std::string> named = line.all("answer");
    if (named.empty())
        throw Error(ErrorCategory::bad_request,
                    "candela exercise grade needs answers: files, or folders with *.answer files");
    const std::vector<fs::path> files = answers_in(named);
    candela::Registry registry = registry_from(line);
    Grader grader(registry, seconds);
    std::vector<Grade> grades;
    {
        ProgressBar bar("grading", !is_quiet());
        for (const fs::path& file : files) {
            grades.push_back(grader.grade(file));
            bar.update(grades.size(), files.size());
        }
    }
    if (line.has("json")) {
        Json all = Json::array();
        for (const Grade& grade : grades) all.push_back(json_of(grade));
        std::cout << json_text(all, 2) << '\n';
    } else {
        std::cout << table(grades);
    }
    const bool all_match =
        std::ranges::all_of(grades, [](const Grade& grade) { return grade.result == Result::matches; });
    return static_cast<int>(all_match ? ExitCode::ok : ExitCode::verification_failed);
}
