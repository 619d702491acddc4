// The verbs of `candela exercise`.
#pragma once

#include <string>
#include <vector>

int run_exercise_new(const std::vector<std::string>& arguments);
int run_exercise_grade(const std::vector<std::string>& arguments);
