// candela diff: measures how two pictures differ, with the program candela-diff.
#include <string>
#include <vector>

#include "cli/commands.h"
#include "programs/sibling_program.h"

int run_diff(const std::vector<std::string>& arguments) { exec_sibling(comparing_program(), arguments); }
