// The verbs of `candela plugin`: one file each.
#pragma once

#include <string>
#include <vector>

int run_plugin_new(const std::vector<std::string>& arguments);
int run_plugin_test(const std::vector<std::string>& arguments);
int run_plugin_doctor(const std::vector<std::string>& arguments);
