// candela diff: figures of how two pictures differ, by the program candela-diff.
#include <string>
#include <vector>

#include "helper.h"
#include "verbs.h"

int run_diff(const std::vector<std::string>& arguments) { become_helper(comparing_program(), arguments); }
