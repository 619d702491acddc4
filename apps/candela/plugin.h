// The verbs of `candela plugin`: one file each.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// Where something is that is installed beside the command, relative to the prefix.
std::filesystem::path beside_command(const char* relative);

int run_plugin_new(const std::vector<std::string>& arguments);
int run_plugin_test(const std::vector<std::string>& arguments);
int run_plugin_doctor(const std::vector<std::string>& arguments);
