// The groups of checks: Catch2 test cases, tagged with the kinds that they are for.
#pragma once

#include <string>
#include <vector>

#include "child.h"

/// The groups for plugins of a kind ("reflection"), in the order of their files and lines; tagged [all] or
/// [<kind>].
std::vector<std::string> groups_for(const std::string& kind);

/// Runs one group in this process.
void run_group(const std::string& group, Findings& findings);
