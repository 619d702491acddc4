// candela exercise new|grade: a formula to be found, and how near answers come.
#include <string>
#include <vector>

#include "exercise.h"
#include "subverbs.h"
#include "verbs.h"

int run_exercise(const std::vector<std::string>& arguments) {
    static constexpr Verb k_exercise_verbs[] = {
        {"new", "make a page in which a model's formula is to be found", run_exercise_new},
        {"grade", "say how far answers are off", run_exercise_grade},
    };
    return run_subverb("exercise", k_exercise_verbs, arguments);
}
