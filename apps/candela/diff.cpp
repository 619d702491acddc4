// candela diff: measures how two pictures differ, with the program candela-diff.
#include <string>
#include <vector>

#include "helper.h"
#include "verbs.h"

int run_diff(const std::vector<std::string>& arguments) { become_helper(comparing_program(), arguments); }
