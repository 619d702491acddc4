// candela exercise new|grade: fill-in-the-formula exercises and their grading.
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/subcommands.h"
#include "commands/exercise.h"

int run_exercise(const std::vector<std::string>& arguments) {
    static constexpr Verb k_exercise_verbs[] = {
        {"new", "create a fill-in-the-formula exercise", run_exercise_new},
        {"grade", "grade saved answers", run_exercise_grade},
    };
    return run_subverb("exercise", k_exercise_verbs, arguments);
}
